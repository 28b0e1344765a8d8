import * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import { readUniverse } from '@/model/universe/read';
import { HALL, openUniverse } from '../../../harness/documents';
import { objectsOf } from '../../../harness/scene';
import { fakeServer } from '../../../harness/testing';
import { EditorTextures } from './textures';
import { UniverseScene } from './UniverseScene';

const URDF = `<robot name="r"><link name="base"><visual><origin xyz="0 0 0.5"/>
  <geometry><box size="0.2 0.2 1"/></geometry></visual></link></robot>`;

/** Returns a scene that shows a universe's text; robots look like a box 1 m high. */
function shown(text: string) {
  fakeServer({ 'GET /catalog/robots/turtle2/urdf': new Response(URDF) });
  openUniverse(text, { 'models/tower.urdf': URDF });
  const onArrival = vi.fn();
  const scene = new UniverseScene(true, onArrival, new EditorTextures(() => undefined, 1));
  const show = (next: string) => scene.showUniverse(readUniverse(next).universe!);
  show(text);
  return { scene, onArrival, show };
}

const size = (scene: UniverseScene, key: string) =>
  scene
    .boundsOf([key])
    .getSize(new THREE.Vector3())
    .toArray()
    .map((part) => Math.round(part * 100) / 100);

const frame = (node: THREE.Object3D) => node.children.find((child) => child.userData['isMark'])!;

describe('UniverseScene', () => {
  it('draws every thing at its place, in its size', () => {
    const { scene } = shown(HALL);
    expect(scene.group.children).toHaveLength(5);
    expect(scene.nodeOf('crate')?.position.toArray()).toEqual([1, 2, 0.2]);
    expect(size(scene, 'crate')).toEqual([0.4, 0.4, 0.4]);
    expect(size(scene, 'ball')).toEqual([0.24, 0.24, 0.24]);
    expect(size(scene, 'carpet')).toEqual([4, 4, 0]);
  });

  it('puts a person at the start of the path, facing along it', () => {
    const { scene } = shown(HALL.replace('[[0, 0], [2, 0], [2, 2]]', '[[1, 1], [1, 3]]'));
    const node = scene.nodeOf('walker')!;
    const person = node.children[0]!;
    expect(node.position.toArray()).toEqual([0, 0, 0]);
    expect(person.position.toArray()).toEqual([1, 1, 0]);
    expect(person.rotation.z).toBeCloseTo(Math.PI / 2);
    // The frame surrounds the person, not the whole path.
    const bounds = new THREE.Box3().setFromObject(frame(node));
    expect(bounds.max.y).toBeLessThan(1.5);
    expect(bounds.min.y).toBeGreaterThan(0.5);
  });

  it('shows a robot as soon as its URDF has arrived, and a box before', async () => {
    const { scene, onArrival } = shown(HALL);
    expect(size(scene, 'robot')[2]).toBe(0.35);
    await vi.waitFor(() => expect(onArrival).toHaveBeenCalled());
    const [body] = objectsOf(scene.nodeOf('robot')!, THREE.Mesh);
    expect(new THREE.Box3().setFromObject(body!).getSize(new THREE.Vector3()).z).toBeCloseTo(1);
    expect(scene.nodeOf('robot')?.position.toArray()).toEqual([3, 3, 0]);
  });

  it('shows a model of links, and boxes for models that it cannot read', async () => {
    const models = `models:
  - {id: tower, shape: urdf, file: models/tower.urdf, pose: [0, 0, 0, 0, 0, 0]}
  - {id: other, shape: sdf, file: models/other.sdf, pose: [2, 0, 0, 0, 0, 0]}
`;
    const { scene, onArrival } = shown(HALL.replace(/models:[^]*actors/, `${models}actors`));
    expect(size(scene, 'other')).toEqual([0.5, 0.5, 0.5]);
    expect(size(scene, 'tower')).toEqual([0.5, 0.5, 0.5]);
    await vi.waitFor(() => expect(onArrival).toHaveBeenCalledTimes(2));
    expect(size(scene, 'tower')).toEqual([0.2, 0.2, 1]);
  });

  it('marks a mesh that cannot be loaded', async () => {
    const models = `models:
  - {id: chair, shape: mesh, file: assets/chair.stl, size: [1, 1, 1], pose: [0, 0, 0, 0, 0, 0]}
`;
    const { scene, onArrival } = shown(HALL.replace(/models:[^]*actors/, `${models}actors`));
    const color = () => {
      const [box] = objectsOf(scene.nodeOf('chair')!, THREE.Mesh);
      return (box!.material as THREE.MeshBasicMaterial).color.clone();
    };
    const pending = color();
    await vi.waitFor(() => expect(onArrival).toHaveBeenCalledTimes(2));
    expect(size(scene, 'chair')).toEqual([0.4, 0.4, 0.4]);
    expect(color().r).toBeGreaterThan(pending.r);
    expect(color().g).toBeLessThan(pending.g);
  });

  it('draws areas on the floor, with a handle at each corner', () => {
    const { scene, show } = shown(`${HALL}areas:\n  door: {box: [1, 2, 4, 4]}\n`);
    const node = scene.nodeOf('door')!;
    const floor = () => new THREE.Box3().setFromObject(scene.nodeOf('door')!.children[0]!);
    expect(floor().min.toArray().slice(0, 2)).toEqual([1, 2]);
    expect(floor().max.toArray().slice(0, 2)).toEqual([4, 4]);
    const handles = node.children.filter((child) => 'waypoint' in child.userData);
    expect(handles.map(({ position: { x, y } }) => [x, y])).toContainEqual([4, 4]);
    expect(handles).toHaveLength(4);
    show(`${HALL}areas:\n  door: {box: [1, 2, 5, 4]}\n`);
    expect(floor().max.x).toBe(5);
  });

  it('keeps the objects of things that did not change', () => {
    const { scene, show } = shown(HALL);
    const crate = scene.nodeOf('crate');
    const ball = scene.nodeOf('ball');
    show(HALL.replace('#c28a52', '#000000'));
    expect(scene.nodeOf('ball')).toBe(ball);
    expect(scene.nodeOf('crate')).not.toBe(crate);
    show(HALL.replace(/ {2}- \{id: crate.*\n/, ''));
    expect(scene.nodeOf('crate')).toBeUndefined();
    expect(scene.group.children).toHaveLength(4);
  });
});
