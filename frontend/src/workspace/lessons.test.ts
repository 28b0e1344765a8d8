import { Actions, type Model } from 'flexlayout-react';
import { beforeEach, describe, expect, it } from 'vitest';
import { openProject } from '../../harness/testing';
import { keepLayout, loadLayout } from './layoutModel';
import { keepLesson, openLesson, setOpensLessons, showLesson, useLessons } from './lessons';
import { useTabs } from './tabs';

const trees = { Main: { r: { type: 'Sequence' } } };

function open(texts: Record<string, string> = { 'lessons/en.md': '# One' }): Model {
  openProject({ trees, texts });
  const model = loadLayout('wide', true);
  useTabs.setState({ model, width: 'wide' });
  return model;
}

const lessonOf = (model: Model) => model.getNodeById('lesson');

beforeEach(() => {
  localStorage.clear();
  useLessons.setState({ opens: true, closed: [] });
});

describe('openLesson', () => {
  it('opens the lesson of a project that has one beside the inspector, so that the tree keeps its width', () => {
    const model = open();
    openLesson('p');
    expect(lessonOf(model)?.getParent()).toBe(model.getNodeById('inspector')?.getParent());
  });

  it('opens nothing for a project without a lesson', () => {
    const model = open({});
    openLesson('p');
    expect(lessonOf(model)).toBeUndefined();
  });

  it('does not open a lesson again that the user has closed in that project', () => {
    const model = open();
    openLesson('p');
    model.doAction(Actions.deleteTab('lesson'));
    keepLesson('p', model);
    openLesson('p');
    expect(lessonOf(model)).toBeUndefined();
    openLesson('q');
    expect(lessonOf(model)).toBeDefined();
    keepLesson('p', model);
    expect(useLessons.getState().closed).toEqual([]);
  });

  it('opens none if the user has turned lessons off', () => {
    setOpensLessons(false);
    const model = open();
    openLesson('p');
    keepLesson('p', model);
    expect(lessonOf(model)).toBeUndefined();
    expect(useLessons.getState().closed).toEqual([]);
  });
});

it('shows an open lesson instead of closing it', () => {
  const model = open();
  showLesson();
  showLesson();
  expect(lessonOf(model)).toBeDefined();
});

it('leaves the lesson out of the layout, which belongs to the user', () => {
  const model = open();
  showLesson();
  keepLayout('wide', 'full', model);
  const again = loadLayout('wide', true);
  expect(lessonOf(again)).toBeUndefined();
  const empty: string[] = [];
  again.visitNodes((node) => {
    if (node.getType() === 'tabset' && node.getChildren().length === 0) empty.push(node.getId());
  });
  expect(empty).toEqual(['editors']);
});
