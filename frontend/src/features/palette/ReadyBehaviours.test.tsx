import { screen, waitFor } from '@testing-library/react';
import { expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { oneBlock } from '@/store/testing';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { ReadyBehaviours } from './ReadyBehaviours';

const behaviour = (id: string, summary: string) => ({
  id,
  version: '1.1',
  group: 'motion',
  summary: { en: summary },
  doc: {},
  diagram: JSON.parse(oneBlock(id, 'AlwaysSuccess')) as unknown,
  files: { [`trees/${id}.json`]: oneBlock(id, 'AlwaysSuccess') },
});

it('lists the behaviours of the library by name, folded, and a search unfolds it', async () => {
  openProject({ trees: { Main: { r: { type: 'Sequence', children: [] } } }, selected: ['r'] });
  fakeServer({
    'GET /catalog/behaviours': [behaviour('Dock', 'Docks.'), behaviour('Patrol', 'Goes around.')],
  });
  const { rerender } = show(<ReadyBehaviours search="" />);
  const title = await screen.findByTestId('ready-behaviours');
  expect(title).toHaveTextContent('Ready behaviours2');
  expect(screen.queryByRole('button', { name: 'Add Dock' })).toBeNull();
  rerender(<ReadyBehaviours search="around" />);
  expect(screen.getAllByRole('button', { name: /^Add/ }).map(({ textContent }) => textContent)).toEqual([
    'Patrol',
  ]);
  rerender(<ReadyBehaviours search="" />);
  await user.click(title);
  await user.click(screen.getByRole('button', { name: 'Add Dock' }));
  await waitFor(() => expect(useProjectStore.getState().diagrams['Dock']).toBeDefined());
  const { diagrams } = useProjectStore.getState();
  expect(Object.values(diagrams['Main']?.nodes ?? {})).toContainEqual(
    expect.objectContaining({ type: 'SubTree', tree: 'Dock' }),
  );
});

it('is not there without behaviours', () => {
  fakeServer({ 'GET /catalog/behaviours': [] });
  show(<ReadyBehaviours search="" />);
  expect(screen.queryByTestId('ready-behaviours')).toBeNull();
});
