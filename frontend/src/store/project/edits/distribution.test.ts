import { beforeEach, expect, it } from 'vitest';
import { serializeDiagram } from '@/model/serialize';
import { useProjectStore } from '..';
import { fakeServer, openProject } from '../../../../harness/testing';
import { changeDistribution, distributionOf } from './distribution';

const store = () => useProjectStore.getState();
const types = (tree: string) => Object.values(store().diagrams[tree]?.nodes ?? {}).map(({ type }) => type);
const OLD = 'actions/IsPathValid.py';
const NEW = 'actions/ValidatePath.py';

beforeEach(() => {
  const block = { a: { type: 'IsPathValid' } };
  openProject({ trees: { Main: block, Dock: block } });
  store().addFile(OLD, 'class IsPathValid: ...');
  store().addFile('project.json', '{}');
  store().setSettings({ ros_distro: 'jazzy' });
});

function answering(lacks: readonly string[] = []) {
  const { diagrams, settings, projectId } = store();
  const trees = Object.values(diagrams).map((diagram) => ({
    path: `trees/${diagram.id}.json`,
    content: serializeDiagram({ ...diagram, nodes: { a: { type: 'ValidatePath' } } }),
  }));
  const files = [
    ...trees,
    { path: OLD, content: null },
    { path: NEW, content: 'class ValidatePath: ...' },
    { path: 'project.json', content: JSON.stringify({ ...settings, ros_distro: 'lyrical' }) },
  ];
  return fakeServer({
    [`POST /projects/${projectId}/distribution`]: { files, lacks, kept: [] },
    [`POST /projects/${projectId}/changes`]: {
      revision: 2,
      files: [],
      actions: [],
      diagnostics: [],
      checked: true,
    },
  });
}

it('renames the blocks of all trees, with their code, as one step', async () => {
  const { requests } = answering(['Wait']);
  expect(await changeDistribution('lyrical')).toEqual({ lacks: ['Wait'], kept: [] });
  expect(requests.at(-1)?.body).toEqual({ ros_distro: 'lyrical', files: [] });
  expect([types('Main'), types('Dock')]).toEqual([['ValidatePath'], ['ValidatePath']]);
  expect([store().currentText(OLD), store().currentText(NEW)]).toEqual([null, 'class ValidatePath: ...']);
  expect(distributionOf(store())).toBe('lyrical');

  store().undo();
  expect([types('Main'), types('Dock')]).toEqual([['IsPathValid'], ['IsPathValid']]);
  expect([store().currentText(OLD), store().currentText(NEW)]).toEqual(['class IsPathValid: ...', null]);
  expect(distributionOf(store())).toBe('jazzy');

  store().redo();
  expect(distributionOf(store())).toBe('lyrical');
});

it('changes nothing if the server cannot be reached, or the project was left', async () => {
  fakeServer({});
  await expect(changeDistribution('lyrical')).rejects.toThrow();
  expect(types('Main')).toEqual(['IsPathValid']);
  answering();
  const asked = changeDistribution('lyrical');
  store().close();
  expect(await asked).toBeNull();
});

it('is what the project states, else what the server found, else Jazzy', () => {
  expect(distributionOf({ settings: null, rosDistro: null })).toBe('jazzy');
  expect(distributionOf({ settings: null, rosDistro: 'kilted' })).toBe('kilted');
  expect(distributionOf({ ...store(), rosDistro: 'kilted' })).toBe('jazzy');
});
