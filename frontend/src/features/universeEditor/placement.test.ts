import { expect, it, onTestFinished } from 'vitest';
import { openUniverse } from '../../../harness/documents';
import { watchPictures } from '../../../harness/scene';
import { fakeServer } from '../../../harness/testing';
import { showIn } from '@/features/editor3d/editing';
import { readingOf } from './editor';
import { placementOf } from './placement';
import { EditorTextures } from './textures';
import { UniverseScene } from './UniverseScene';

function begin(text?: string) {
  fakeServer({});
  watchPictures();
  const editor = openUniverse(text);
  showIn(editor, { center: () => [4.03, 5], forward: () => [1, 0], cancel: () => false });
  const scene = new UniverseScene(true, () => undefined, new EditorTextures(() => undefined, 1), 0.5);
  onTestFinished(() => scene.dispose());
  return { editor, scene, placement: placementOf(editor, scene) };
}

it.each([
  [{ kind: 'box' }, 'box'],
  [{ kind: 'person' }, 'person'],
  [{ kind: 'robot', model: 'turtle2' }, 'robot_2'],
  [{ kind: 'file', shape: 'sdf', file: 'a.sdf' }, 'a'],
])('draws %o alone, in the middle of the view on the grid', (what, key) => {
  const { editor, scene, placement } = begin();
  expect(placement.draw(what)).toEqual({ at: [4, 5], height: 0 });
  expect(scene.nodeOf(key)).toBeDefined();
  expect(scene.group.children).toHaveLength(1);
  expect(readingOf(editor).universe?.things).toHaveLength(5);
  expect(placement.draw(null)).toBeNull();
  expect(scene.group.children).toEqual([]);
});

it('has no ghost in a document that cannot be changed piece by piece', () => {
  const { placement } = begin('name: x\nmodels: &all []\nactors: *all\n');
  expect(placement.draw({ kind: 'box' })).toBeNull();
});

it('adds the thing', () => {
  const { editor, placement } = begin();
  placement.place({ kind: 'box' }, [2, 1]);
  expect(readingOf(editor).universe?.things.find(({ id }) => id === 'box')).toMatchObject({
    pose: [2, 1, 0.3, 0, 0, 0],
  });
});
