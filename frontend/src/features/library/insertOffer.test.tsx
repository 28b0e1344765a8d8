import { screen, waitFor } from '@testing-library/react';
import { expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { oneBlock } from '@/store/testing';
import { openProject, show } from '../../../harness/testing';
import { insertOffer } from './insertOffer';

const offer = {
  id: 'Dock',
  version: '1.1',
  group: 'motion',
  source: 'library',
  project: null,
  owner: null,
  isOffered: true,
  summary: 'Goes home.',
  doc: '',
  diagram: JSON.parse(oneBlock('Dock', 'AlwaysSuccess')) as unknown,
  files: { 'trees/Dock.json': oneBlock('Dock', 'AlwaysSuccess') },
};

it('adds a behaviour as a subtree, with its files, and says so', async () => {
  openProject({ trees: { Main: { r: { type: 'Sequence', children: [] } } }, selected: ['r'] });
  show(<div />);
  insertOffer(offer);
  await waitFor(() => expect(useProjectStore.getState().diagrams['Dock']).toBeDefined());
  const nodes = Object.values(useProjectStore.getState().diagrams['Main']?.nodes ?? {});
  expect(nodes).toContainEqual(expect.objectContaining({ type: 'SubTree', tree: 'Dock' }));
  expect(await screen.findByText(/Dock/)).toBeInTheDocument();
});
