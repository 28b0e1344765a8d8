import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { projectDetail } from '@/store/testing';
import { fakeServer, openProject, watchNavigation } from '../../../harness/testing';
import { renameDocument } from './renaming';

const store = () => useProjectStore.getState();
const texts = {
  'notes.md': 'words',
  'universes/yard.yaml': 'name: yard',
  'robots/mine/robot.yaml': 'name: mine',
  'robots/mine/arm.urdf': '<robot/>',
  'robots/minor/robot.yaml': 'name: minor',
};
let navigator: ReturnType<typeof watchNavigation>;

beforeEach(() => {
  fakeServer({});
  openProject({ texts });
  navigator = watchNavigation();
  useUniverseChoice.setState({ universe: 'other', robot: 'other' });
});

const paths = () => Object.keys(store().files).sort();

describe('renameDocument', () => {
  it('moves a file to another path', async () => {
    await renameDocument('notes.md', 'docs/notes.md');
    expect(store().currentText('docs/notes.md')).toBe('words');
    expect(paths()).not.toContain('notes.md');
    expect(navigator.renamed).toHaveBeenCalledExactlyOnceWith('file', 'notes.md', 'docs/notes.md');
    expect(navigator.openFile).toHaveBeenCalledWith('docs/notes.md', undefined);
    expect(useUniverseChoice.getState()).toMatchObject({ universe: 'other', robot: 'other' });
  });

  it('renames a universe, also in the settings of the project', async () => {
    store().setSettings({ universe: 'yard' });
    await renameDocument('universes/yard.yaml', 'garden');
    expect(store().currentText('universes/garden.yaml')).toBe('name: garden');
    expect(paths()).not.toContain('universes/yard.yaml');
    expect(store().settings?.universe).toBe('garden');
    expect(useUniverseChoice.getState()).toMatchObject({ universe: null, robot: null });
  });

  it.each([
    ['name: Yard # green', 'name: "Big garden" # green'],
    ['name: Our yard', 'name: Our yard'],
  ])('lets a title follow that was made from the old name: %s', async (before, after) => {
    store().setFileText('universes/yard.yaml', before);
    await renameDocument('universes/yard.yaml', 'big_garden');
    expect(store().currentText('universes/big_garden.yaml')).toBe(after);
  });

  it('gives a robot another name with all its files, and leaves other robots', async () => {
    await renameDocument('robots/mine/robot.yaml', 'yours');
    expect(paths().filter((path) => path.startsWith('robots/'))).toEqual([
      'robots/minor/robot.yaml',
      'robots/yours/arm.urdf',
      'robots/yours/robot.yaml',
    ]);
    expect(store().currentText('robots/yours/arm.urdf')).toBe('<robot/>');
    expect(navigator.renamed.mock.calls).toEqual([
      ['file', 'robots/mine/robot.yaml', 'robots/yours/robot.yaml'],
      ['file', 'robots/mine/arm.urdf', 'robots/yours/arm.urdf'],
    ]);
    expect(useUniverseChoice.getState()).toMatchObject({ universe: null, robot: null });
  });

  it('copies binary files on the server before the old ones are deleted', async () => {
    const file = (path: string, content: string | null) => ({
      path,
      revision: 1,
      size: 3,
      sha256: '',
      content,
    });
    const before = projectDetail(1, [file('robots/mine/robot.yaml', 'x'), file('robots/mine/arm.stl', null)]);
    store().load(before);
    const saved = { revision: 2, files: [], actions: [], diagnostics: [] };
    const { requests } = fakeServer({
      'GET /projects/p1/files/robots/mine/arm.stl': new Response('abc'),
      'POST /projects/p1/changes': saved,
      'GET /projects/p1': projectDetail(2, [...before.files, file('robots/yours/arm.stl', null)]),
    });
    await renameDocument('robots/mine/robot.yaml', 'yours');
    expect(requests.at(-2)?.body).toMatchObject({
      files: [{ path: 'robots/yours/arm.stl', base_revision: 0, content_base64: btoa('abc') }],
    });
    expect(paths()).toContain('robots/yours/arm.stl');
    expect(paths()).not.toContain('robots/mine/arm.stl');
  });

  it('renames nothing if a file cannot be fetched', async () => {
    const file = { path: 'a.png', revision: 1, size: 3, sha256: '', content: null };
    store().load(projectDetail(1, [file]));
    await expect(renameDocument('a.png', 'b.png')).rejects.toThrow('a.png: 404');
    expect(paths()).toEqual(['a.png']);
  });
});
