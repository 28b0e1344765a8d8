import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import type { ActorThing } from '@/model/universe/types';
import { valuesOf } from '../../../../harness/scene';
import { arrow, box, frameOf, markLines, wayOf } from './marks';

const walker = (path: ActorThing['path'], loop = true): ActorThing => ({
  section: 'actors',
  key: 'walker',
  id: 'walker',
  index: 0,
  color: '#20c020',
  path,
  speed: 0.5,
  loop,
  start_m: 0,
  yields: false,
});

const sizeOf = (object: THREE.Object3D) =>
  new THREE.Box3()
    .setFromObject(object)
    .getSize(new THREE.Vector3())
    .toArray()
    .map((part) => Math.round(part * 1e4) / 1e4);

/** Returns whether a ray along -z through a point of the floor meets it. */
const isTouched = (object: THREE.Object3D, x: number, y: number): boolean => {
  object.updateMatrixWorld(true);
  const ray = new THREE.Raycaster(new THREE.Vector3(x, y, 5), new THREE.Vector3(0, 0, -1));
  return ray.intersectObject(object).length > 0;
};

describe('box', () => {
  it('stands on the floor in its colour', () => {
    const mesh = box(0.5, [1, 0.5, 0, 0.25]);
    expect(sizeOf(mesh)).toEqual([0.5, 0.5, 0.5]);
    expect(mesh.position.z).toBe(0.25);
    const material = mesh.material as THREE.MeshBasicMaterial;
    expect(material.color.getHexString()).toBe('ff8000');
    expect([material.opacity, material.transparent, material.wireframe]).toEqual([0.25, true, true]);
    expect(mesh.userData['isOwn']).toBe(true);
  });
});

describe('frameOf', () => {
  it('surrounds the shapes of a node with a margin, at the place of the node', () => {
    const node = new THREE.Group();
    node.position.set(3, 4, 0);
    const mesh = new THREE.Mesh(new THREE.BoxGeometry(1, 2, 1));
    mesh.position.set(0, 0, 0.5);
    node.add(mesh);
    const frame = frameOf(node);
    expect(sizeOf(frame)).toEqual([1.02, 2.02, 1.02]);
    expect(frame.position.toArray()).toEqual([0, 0, 0.5]);
    expect(sizeOf(frameOf(node, 0.5))).toEqual([1.5, 2.5, 1.5]);
  });

  it('is a mark: hidden until needed, in front of everything, and ignored by the pointer', () => {
    const node = new THREE.Group().add(new THREE.Mesh(new THREE.BoxGeometry()));
    const frame = frameOf(node);
    expect(frame.visible).toBe(false);
    expect(frame.userData).toEqual({ isMark: true, isOwn: true });
    expect(frame.renderOrder).toBe(10);
    expect((frame.material as THREE.Material).depthTest).toBe(false);
    frame.visible = true;
    expect(isTouched(frame, 0.51, 0)).toBe(false);
  });
});

describe('markLines', () => {
  it('are hidden lines that the pointer ignores', () => {
    const lines = markLines(
      new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(), new THREE.Vector3(1, 0, 0)]),
    );
    expect(lines.visible).toBe(false);
    expect(lines.frustumCulled).toBe(false);
    expect(lines.userData).toEqual({ isMark: true, isOwn: true });
    expect(isTouched(lines, 0.5, 0)).toBe(false);
  });
});

describe('arrow', () => {
  it('points along x, just above the floor', () => {
    const mesh = arrow();
    const bounds = new THREE.Box3().setFromObject(mesh);
    expect([bounds.min.x, bounds.max.x, bounds.max.y]).toEqual([
      expect.closeTo(0.3),
      expect.closeTo(0.52),
      expect.closeTo(0.09),
    ]);
    expect(mesh.position.z).toBe(0.01);
    expect(isTouched(mesh, 0.4, 0)).toBe(false);
  });
});

describe('wayOf', () => {
  const SQUARE: ActorThing['path'] = [
    [0, 0],
    [2, 0],
    [2, 2],
  ];

  it('is closed for a loop', () => {
    const [line] = wayOf(walker(SQUARE));
    expect(valuesOf((line as THREE.Line).geometry)).toEqual([0, 0, 0.02, 2, 0, 0.02, 2, 2, 0.02, 0, 0, 0.02]);
    expect(line!.userData['isFaint']).toBe(true);
  });

  it.each([
    ['to and fro', SQUARE, false, 3],
    ['between two points', SQUARE.slice(0, 2), true, 2],
  ] as const)('stays open for %s', (_, path, loop, count) => {
    const [line] = wayOf(walker(path, loop));
    expect(valuesOf((line as THREE.Line).geometry)).toHaveLength(3 * count);
  });

  it('has a handle at each point, which can be grabbed; the first has another colour', () => {
    const handles = wayOf(walker(SQUARE)).slice(1) as THREE.Mesh<
      THREE.BufferGeometry,
      THREE.MeshBasicMaterial
    >[];
    expect(handles.map(({ position }) => position.toArray())).toEqual([
      [0, 0, 0.03],
      [2, 0, 0.03],
      [2, 2, 0.03],
    ]);
    expect(handles.map(({ userData }) => userData)).toEqual(
      [0, 1, 2].map((waypoint) => ({ isMark: true, isOwn: true, waypoint })),
    );
    expect(handles.map(({ visible }) => visible)).toEqual([false, false, false]);
    expect(isTouched(handles[1]!, 2.1, 0)).toBe(true);
    expect(isTouched(handles[1]!, 2.12, 0)).toBe(false);
    const colors = handles.map(({ material }) => material.color.getHexString());
    expect(colors).toEqual(['ff9f1a', '6f7dff', '6f7dff']);
  });
});
