import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { refusal } from '../../../harness/requests';
import { fakeServer, openProject, show } from '../../../harness/testing';
import { ExportContents } from './ExportContents';

const PREVIEW = 'GET /projects/p1/package/preview?name=';
const SAVE = 'POST /projects/p1/changes';
const NOT_SAVED = /The latest edits could not be saved/;
const preview = { name: 'test', files: [], manifest: '<package/>', diagnostics: [] };

function open(answers: Readonly<Record<string, unknown>>) {
  const { requests } = fakeServer({ [PREVIEW]: preview, ...answers });
  openProject({ texts: { 'notes.md': 'old' } });
  useProjectStore.getState().setFileText('notes.md', 'new');
  show(<ExportContents />);
  return () => requests.map(({ method, path }) => `${method} ${path}`);
}

it('saves first, so that the export has the latest edits', async () => {
  const file = { path: 'notes.md', revision: 2, size: 3, sha256: '' };
  const asked = open({ [SAVE]: { revision: 2, files: [file], actions: [], diagnostics: [] } });
  expect(screen.getByText(/Saving first/)).toBeInTheDocument();
  expect(screen.queryByText('Other downloads')).toBeNull();
  expect(await screen.findByText('Other downloads')).toBeInTheDocument();
  expect(await screen.findByText('0 files')).toBeInTheDocument();
  expect(screen.queryByText(/Saving first/)).toBeNull();
  expect(screen.queryByText(NOT_SAVED)).toBeNull();
  expect(asked()).toEqual([SAVE, PREVIEW]);
});

it('reports that the latest edits are missing if they cannot be saved', async () => {
  open({ [SAVE]: refusal('No room.') });
  expect(await screen.findByText(NOT_SAVED)).toBeInTheDocument();
  expect(screen.getByText('Other downloads')).toBeInTheDocument();
});

it('is empty without a project', () => {
  fakeServer({});
  const { container } = show(<ExportContents />);
  expect(container.textContent).toBe('');
});
