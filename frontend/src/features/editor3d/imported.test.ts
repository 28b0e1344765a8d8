import { screen } from '@testing-library/react';
import { createElement } from 'react';
import { beforeEach, expect, it, vi } from 'vitest';
import type { ImportedPart } from '@/api/imports';
import '@/i18n/editorTexts';
import { useProjectStore } from '@/store/project';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { projectDetail, projectFile } from '@/store/testing';
import { refusal } from '../../../harness/requests';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { change, editorFor } from './editing';
import { isImportOf, recordImport, travelOrUndoImport, undoImport, useImported } from './imported';

const ROBOT = 'robots/cart/robot.yaml';
const MESH = 'robots/cart/a.stl';
const MANIFEST = 'project.json';
const part = (more: Partial<ImportedPart> = {}): ImportedPart => ({
  revision: 3,
  previous_revision: 2,
  path: ROBOT,
  name: 'cart',
  paths: [ROBOT],
  removed: [],
  report: { taken: [], assumed: [], left_out: [] },
  test_drive: null,
  can_simplify: false,
  things: null,
  ...more,
});
const before = projectDetail(4, [projectFile('trees/MainTree.json', 1, '{}')]);
const after = projectDetail(5, [projectFile(ROBOT, 5, 'name: Cart\n')]);

const store = () => useProjectStore.getState();
const NOTHING = { files: {}, settings: null };
const undone = (files: readonly string[] = [], revision = 4) =>
  projectDetail(
    revision,
    files.map((path) => projectFile(path, revision, '')),
  );
const bodies = (requests: readonly { body: unknown; method: string }[]) =>
  requests.filter(({ method }) => method === 'POST').map(({ body }) => body);

/** Opens the project after an import, in which the settings have this revision. */
function imported(settings: number, paths = [ROBOT]) {
  openProject({});
  store().load({
    ...projectDetail(3, [
      ...paths.map((path) => projectFile(path, 3, `${path}\n`)),
      projectFile(MANIFEST, settings, '{}'),
    ]),
    settings: { name: 'Test', main_tree: 'MainTree', robot: 'cart' },
  });
}

beforeEach(() => {
  useImported.setState({ step: null });
  return () => useUniverseChoice.setState({ universe: null, robot: null });
});

it('takes an import back as one revision, and brings it back', async () => {
  openProject({ texts: { [ROBOT]: 'name: Cart\n' } });
  const { requests } = fakeServer({
    'POST /projects/p1/revisions/2/restore': before,
    'POST /projects/p1/revisions/3/restore': after,
  });
  show(createElement('p'));
  useUniverseChoice.setState({ robot: 'cart' });
  recordImport(part(), 'robot', NOTHING);
  expect(isImportOf(useImported.getState().step, ROBOT)).toBe(true);
  await undoImport();
  expect(requests.map(({ body }) => body)).toEqual([{ paths: [ROBOT] }]);
  expect(store().files[ROBOT]).toBeUndefined();
  expect(useUniverseChoice.getState().robot).toBeNull();
  expect(useImported.getState().step).toBeNull();
  await user.click(await screen.findByRole('button', { name: 'Bring it back' }));
  await vi.waitFor(() => expect(useImported.getState().step).toMatchObject({ before: 4, after: 5 }));
  expect(store().currentText(ROBOT)).toBe('name: Cart\n');
});

it('counts an import that replaces the last one as the same step', async () => {
  const { requests } = fakeServer({ 'POST /projects/p1/revisions/2/restore': undone([MANIFEST]) });
  imported(3, [ROBOT, MESH]);
  recordImport(part({ paths: [MESH, ROBOT] }), 'robot', NOTHING);
  const { files, settings } = store();
  imported(3);
  // The second import removes what the first one wrote, and leaves the settings as they are.
  const second = part({ previous_revision: 3, revision: 4, removed: [MESH] });
  recordImport(second, 'robot', { files, settings });
  expect(useImported.getState().step).toMatchObject({ before: 2, after: 4, usedBefore: undefined });
  store().applySaved([], { revision: 4, files: [], diagnostics: [], actions: [], checked: true });
  await undoImport();
  expect(bodies(requests)).toEqual([{ paths: [ROBOT, MANIFEST] }]);
});

it('asks only for what is there, now or before the import', async () => {
  const OLD = 'robots/cart/old.stl';
  const { requests } = fakeServer({ 'POST /projects/p1/revisions/2/restore': undone([MANIFEST]) });
  imported(3);
  const { files } = useProjectStore.getState();
  // A mesh of the import was deleted since.
  const known = { [OLD]: files[ROBOT]!, [ROBOT]: files[ROBOT]! };
  recordImport(part({ paths: [MESH, ROBOT], removed: [OLD] }), 'robot', { files: known, settings: null });
  await undoImport();
  expect(bodies(requests)).toEqual([{ paths: [ROBOT, OLD, MANIFEST] }]);
});

it('restores nothing where all that it wrote is gone', async () => {
  const { requests } = fakeServer({});
  show(createElement('p'));
  imported(1, []);
  recordImport(part(), 'robot', { files: {}, settings: null });
  await undoImport();
  await user.click(await screen.findByRole('button', { name: 'Bring it back' }));
  await vi.waitFor(() => expect(useImported.getState().step).not.toBeNull());
  expect(requests).toEqual([]);
});

it('leaves settings that were changed since, but not the name of what is gone', async () => {
  const settings = { name: 'Test', main_tree: 'MainTree', tick_hz: 5 };
  const { requests } = fakeServer({
    'POST /projects/p1/revisions/2/restore': {
      ...undone([MANIFEST]),
      settings: { ...settings, robot: 'cart' },
    },
    'POST /projects/p1/revisions/3/restore': {
      ...undone([MANIFEST, ROBOT], 5),
      settings: { ...settings, robot: 'turtle2' },
    },
    'POST /projects/p1/changes': { revision: 4, files: [], diagnostics: [], actions: [], checked: true },
  });
  imported(3);
  show(createElement('p'));
  recordImport(part(), 'robot', { files: {}, settings: { ...settings, robot: 'turtle2' } });
  store().setSettings({ tick_hz: 5 });
  await undoImport();
  expect(bodies(requests)).toContainEqual({ paths: [ROBOT] });
  expect(JSON.parse(store().currentText(MANIFEST)!)).toMatchObject({ tick_hz: 5, robot: 'turtle2' });
  await user.click(await screen.findByRole('button', { name: 'Bring it back' }));
  await vi.waitFor(() => expect(store().settings).toMatchObject({ tick_hz: 5, robot: 'cart' }));
});

it('is the first step of an editor that was open before', () => {
  openProject({ texts: { [ROBOT]: 'name: Old\n' } });
  useProjectStore.setState({ projectId: 'own-open' });
  const editor = editorFor(ROBOT, { pathsOf: () => [], keysOf: () => [], grid: 0.1 });
  change(editor, 'one', () => ({ texts: ['name: Older\n'] }));
  store().setFileText(ROBOT, 'name: Cart\n');
  recordImport(part(), 'robot', NOTHING);
  expect(editor.store.getState().undoStack).toMatchObject({ past: [], texts: ['name: Cart\n'] });
});

it('is not taken back by Undo once its document was changed elsewhere', () => {
  openProject({ texts: { [ROBOT]: 'name: Cart\n' } });
  useProjectStore.setState({ projectId: 'own-changed' });
  const { requests } = fakeServer({});
  const editor = editorFor(ROBOT, { pathsOf: () => [], keysOf: () => [], grid: 0.1 });
  recordImport(part(), 'robot', NOTHING);
  expect(isImportOf(useImported.getState().step, ROBOT)).toBe(true);
  store().setFileText(ROBOT, 'name: Mine\n');
  expect(isImportOf(useImported.getState().step, ROBOT)).toBe(false);
  travelOrUndoImport(editor, 'undo');
  expect(useImported.getState().step).not.toBeNull();
  expect(requests).toEqual([]);
});

it('can be tried again when it failed, and says what failed', async () => {
  openProject({ texts: { [ROBOT]: 'name: Cart\n' } });
  fakeServer({ 'POST /projects/p1/revisions/2/restore': refusal('No room.') });
  show(createElement('p'));
  recordImport(part(), 'robot', NOTHING);
  await undoImport();
  expect(await screen.findByText('The import could not be undone')).toBeInTheDocument();
  expect(useImported.getState().step).not.toBeNull();
  fakeServer({
    'POST /projects/p1/revisions/2/restore': before,
    'POST /projects/p1/revisions/3/restore': refusal('No room.', { hint: 'Delete one.' }),
  });
  await undoImport();
  const [button] = (await screen.findAllByRole('button', { name: 'Bring it back' })).slice(-1);
  await user.click(button!);
  expect(await screen.findByText('The import could not be brought back')).toBeInTheDocument();
  expect(screen.getByText('No room. Delete one.')).toBeInTheDocument();
});
