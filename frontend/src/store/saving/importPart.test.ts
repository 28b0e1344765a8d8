import { expect, it, vi } from 'vitest';
import type { ImportWish } from '@/api/imports';
import { refusal } from '../../../harness/requests';
import { fakeServer, openProject } from '../../../harness/testing';
import { useProjectStore } from '../project';
import { projectDetail, projectFile } from '../testing';
import { importPart } from './importPart';

const TAKE =
  'POST /projects/p1/imports?filename=a.sdf&kind=universe&main=a.sdf&name=a&use=true&replace=false&simplify=false';
const PART = { revision: 2, path: 'universes/a.yaml' };
const WISH: ImportWish = {
  ...{ kind: 'universe', main: 'a.sdf', name: 'a', args: {}, use: true, replace: false, simplify: false },
};
const upload = { name: 'a.sdf', data: new Blob(['x']) };
const onLate = vi.fn();

function begin(wish = WISH, controller = new AbortController()) {
  onLate.mockClear();
  return importPart('p1', upload, wish, controller.signal, onLate);
}

const aborted = () => {
  const controller = new AbortController();
  controller.abort();
  return controller;
};

it('loads what the server wrote', async () => {
  openProject({});
  fakeServer({
    [TAKE]: PART,
    'GET /projects/p1': projectDetail(2, [projectFile('universes/a.yaml', 2, 'name: A\n')]),
  });
  expect(await begin()).toEqual(PART);
  expect(useProjectStore.getState().currentText('universes/a.yaml')).toBe('name: A\n');
  expect(onLate).not.toHaveBeenCalled();
});

it('has a result also when the project cannot be loaded after it', async () => {
  openProject({});
  fakeServer({ [TAKE]: PART });
  expect(await begin()).toEqual(PART);
});

it.each([
  ['answered', PART],
  ['lost', refusal('Gone.')],
])('says what came in although it was cancelled, when the answer is %s', async (_, answer) => {
  openProject({ texts: { 'assets/a/old.stl': '', 'notes.md': '' } });
  const written = ['universes/a.yaml', 'assets/a/new.stl', 'assets/b/other.stl'];
  fakeServer({
    [TAKE]: answer,
    'GET /projects/p1': projectDetail(2, [
      ...written.map((path) => projectFile(path, 2, '')),
      projectFile('notes.md', 1, ''),
    ]),
  });
  await expect(begin(WISH, aborted())).rejects.toThrow();
  expect(onLate).toHaveBeenCalledExactlyOnceWith({
    ...{ revision: 2, previous_revision: 1, path: 'universes/a.yaml', name: 'a' },
    paths: ['universes/a.yaml', 'assets/a/new.stl'],
    removed: ['assets/a/old.stl'],
  });
});

it('says nothing when the cancel came in time', async () => {
  openProject({ texts: { 'robots/a/robot.yaml': '' } });
  fakeServer({ 'GET /projects/p1': projectDetail(2, [projectFile('robots/a/robot.yaml', 1, '')]) });
  await expect(begin({ ...WISH, kind: 'robot' }, aborted())).rejects.toThrow();
  expect(onLate).not.toHaveBeenCalled();
});
