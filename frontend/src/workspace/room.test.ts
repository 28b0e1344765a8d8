import { Actions, Rect, TabSetNode, type Model } from 'flexlayout-react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { keepLayout, loadLayout } from './layoutModel';
import { giveRoom } from './room';

const HEIGHT = 800;
let model: Model;

const setOf = (id: string) => {
  const node = model.getNodeById(id);
  if (!(node instanceof TabSetNode)) throw new Error(`${id} is no set of tabs`);
  return node;
};
/** Measures the column of the documents as a page of this height does. */
const measure = (height = HEIGHT) => {
  const sets = [setOf('editors'), setOf('output')];
  const whole = sets.reduce((sum, set) => sum + set.getWeight(), 0);
  for (const set of sets) {
    const rect = new Rect(0, 0, 700, (height * set.getWeight()) / whole);
    vi.spyOn(set, 'getRect').mockReturnValue(rect);
  }
};
const height = (id: string, whole = HEIGHT) => {
  measure(whole);
  return Math.round(setOf(id).getRect().height);
};
const show = (id: string) => {
  model.doAction(Actions.selectTab(id));
  giveRoom(model);
};

beforeEach(() => {
  localStorage.clear();
  model = loadLayout('wide', true);
  measure();
});

describe('giveRoom', () => {
  it('makes a panel as high as it needs when it is shown first', () => {
    show('problems');
    expect(height('output')).toBe(208);
    show('topics');
    expect(height('output')).toBe(270);
    show('evaluate');
    expect([height('output'), height('editors')]).toEqual([340, 460]);
  });

  it('leaves the documents their part of a low page', () => {
    measure(400);
    show('evaluate');
    expect(height('editors', 400)).toBe(160);
  });

  it('leaves the height to the user from then on, also in the kept layout', () => {
    show('evaluate');
    model.doAction(Actions.adjustWeights(setOf('editors').getParent()!.getId(), [80, 20]));
    show('console');
    keepLayout('wide', 'full', model);
    model = loadLayout('wide', true);
    measure();
    show('evaluate');
    expect(height('output')).toBe(160);
  });

  it('changes nothing that is not measured, hidden, high enough, or lies beside the documents', () => {
    model = loadLayout('wide', true);
    const before = JSON.stringify(model.toJson());
    giveRoom(model);
    expect(JSON.stringify(model.toJson())).toBe(before);
    measure(2000);
    show('evaluate');
    expect(setOf('output').getWeight()).toBe(26);
  });
});
