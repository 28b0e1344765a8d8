import type { TFunction } from 'i18next';
import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { t } from '@/i18n';
import { fakeServer, show } from '../../../harness/testing';
import { templateText, useSortedTemplates } from './templates';

const template = (id: string) => ({ id, name: `${id} of the server`, description: `About ${id}` });

function Ids() {
  return (
    <p>
      {useSortedTemplates()
        .all.map(({ id }) => id)
        .join(' ')}
    </p>
  );
}

describe('useSortedTemplates', () => {
  it('has the empty project at once, and the known ones in order', async () => {
    const templates = ['mine', 'visual_follow_person', 'yours', 'laser_bump_and_go'].map(template);
    fakeServer({ 'GET /catalog/templates': templates });
    show(<Ids />);
    expect(screen.getByText('empty')).toBeInTheDocument();
    expect(
      await screen.findByText('laser_bump_and_go visual_follow_person empty mine yours'),
    ).toBeInTheDocument();
  });

  it('has an empty project only once', async () => {
    fakeServer({ 'GET /catalog/templates': [template('empty'), template('laser_bump_and_go')] });
    show(<Ids />);
    expect(await screen.findByText('laser_bump_and_go empty')).toBeInTheDocument();
  });
});

it('translates the text of a template if there is a translation', () => {
  const say = ((key: string) => t(`projects:${key}`)) as TFunction<'projects'>;
  expect(templateText(say, template('empty'), 'name')).toBe('Empty project');
  expect(templateText(say, template('empty'), 'description')).toBe('A blank canvas in a walled room.');
  expect(templateText(say, template('mine'), 'name')).toBe('mine of the server');
  expect(templateText(say, template('mine'), 'description')).toBe('About mine');
});
