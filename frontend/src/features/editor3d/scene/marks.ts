import * as THREE from 'three';
import type { Point } from '@/model/document/values';
import type { ActorThing } from '@/model/universe/types';

const ACCENT = 0x6f7dff;
const CHOSEN = 0xff9f1a;

/** Makes the pointer ignore a mark, since marks are not part of their thing. */
const untouchable = <T extends THREE.Object3D>(object: T): T => {
  object.raycast = () => undefined;
  object.userData['isOwn'] = true;
  return object;
};

/** Returns a box in place of shapes that have not arrived. */
export function box(size: number, [r = 0, g = 0, b = 0, a = 1]: readonly number[]): THREE.Mesh {
  const color = new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace);
  const mesh = new THREE.Mesh(
    new THREE.BoxGeometry(size, size, size),
    new THREE.MeshBasicMaterial({ color, transparent: true, opacity: a, wireframe: true }),
  );
  mesh.position.z = size / 2;
  mesh.userData['isOwn'] = true;
  return mesh;
}

/** Returns the edges of a node's bounding box in the node's own axes; other objects never hide them. */
export function frameOf(node: THREE.Object3D, pad = 0.02): THREE.LineSegments {
  const bounds = new THREE.Box3().setFromObject(node, true);
  bounds.translate(node.position.clone().negate());
  const size = bounds.getSize(new THREE.Vector3()).addScalar(pad);
  const edges = new THREE.EdgesGeometry(new THREE.BoxGeometry(size.x, size.y, size.z));
  const material = new THREE.LineBasicMaterial({ color: ACCENT, depthTest: false, transparent: true });
  const frame = untouchable(new THREE.LineSegments(edges, material));
  frame.position.copy(bounds.getCenter(new THREE.Vector3()));
  frame.renderOrder = 10;
  frame.visible = false;
  frame.userData['isMark'] = true;
  return frame;
}

/** Returns lines that are visible while their thing is selected. */
export function markLines(geometry: THREE.BufferGeometry): THREE.LineSegments {
  const material = new THREE.LineBasicMaterial({ color: ACCENT, transparent: true, opacity: 0.55 });
  const lines = untouchable(new THREE.LineSegments(geometry, material));
  lines.frustumCulled = false;
  lines.visible = false;
  lines.userData['isMark'] = true;
  return lines;
}

/** Returns an arrow on the floor that shows a robot's heading. */
export function arrow(): THREE.Mesh {
  const outline = new THREE.Shape([
    new THREE.Vector2(0.3, -0.09),
    new THREE.Vector2(0.52, 0),
    new THREE.Vector2(0.3, 0.09),
    new THREE.Vector2(0.35, 0),
  ]);
  const material = new THREE.MeshBasicMaterial({ color: ACCENT, side: THREE.DoubleSide });
  const mesh = untouchable(new THREE.Mesh(new THREE.ShapeGeometry(outline), material));
  mesh.position.z = 0.01;
  return mesh;
}

const AREA = 0x2aa876;

/** Returns an area of the floor, its outline, and a handle at each corner while it is selected. */
export function floorOf(corners: readonly Point[]): THREE.Object3D[] {
  const outline = new THREE.Shape(corners.map(([x, y]) => new THREE.Vector2(x, y)));
  const floor = new THREE.Mesh(
    new THREE.ShapeGeometry(outline),
    new THREE.MeshBasicMaterial({
      color: AREA,
      transparent: true,
      opacity: 0.22,
      side: THREE.DoubleSide,
      depthWrite: false,
    }),
  );
  floor.position.z = 0.012;
  floor.userData['isOwn'] = true;
  return [floor, ...wayOf({ path: corners, loop: true }, AREA)];
}

/** Returns a path on the floor, with a handle at each of its points while its thing is selected. */
export function wayOf({ path, loop }: Pick<ActorThing, 'path' | 'loop'>, color = ACCENT): THREE.Object3D[] {
  const closed = loop && path.length > 2 ? [...path, path[0] ?? [0, 0]] : path;
  const points = closed.map(([x, y]) => new THREE.Vector3(x, y, 0.02));
  const line = untouchable(
    new THREE.Line(
      new THREE.BufferGeometry().setFromPoints(points),
      new THREE.LineBasicMaterial({ color, transparent: true }),
    ),
  );
  line.userData['isFaint'] = true;
  const handles = path.map(([x, y], index) => {
    const handle = new THREE.Mesh(
      new THREE.CylinderGeometry(0.11, 0.11, 0.04, 24).rotateX(Math.PI / 2),
      new THREE.MeshBasicMaterial({ color: index === 0 ? CHOSEN : ACCENT }),
    );
    handle.position.set(x, y, 0.03);
    handle.visible = false;
    handle.userData['isMark'] = true;
    handle.userData['isOwn'] = true;
    handle.userData['waypoint'] = index;
    return handle;
  });
  return [line, ...handles];
}
