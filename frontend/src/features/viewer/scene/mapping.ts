import * as THREE from 'three';
import type { Shape } from '@/generated/messages';

/** The smallest share of z in the normal of a cylinder's lid. */
const FLAT = 0.99;
const TURN = 2 * Math.PI;

type Tile = readonly [number, number];

/**
 * Sets the texture coordinates of each vertex; 1 is one repetition, and v points up. The rules are those of
 * `executor/render/mapping.py`: flat faces are projected along the axis that they face most, cylinders and
 * balls are wrapped.
 *
 * @param geometry three vertices per triangle, in m
 */
export function mapPicture(geometry: THREE.BufferGeometry, shape: Shape['shape'], tile: Tile): void {
  const points = geometry.getAttribute('position');
  const normals = geometry.getAttribute('normal');
  const box = new THREE.Box3().setFromBufferAttribute(points as THREE.BufferAttribute);
  const isRound = shape === 'cylinder' || shape === 'sphere' || shape === 'capsule';
  const radius = Math.max(box.max.x, 0);
  const uvs = new Float32Array(points.count * 2);
  const corners = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()] as const;
  for (let first = 0; first + 2 < points.count; first += 3) {
    corners.forEach((corner, i) => corner.fromBufferAttribute(points, first + i));
    const isSide =
      isRound && (shape !== 'cylinder' || [0, 1, 2].every((i) => Math.abs(normals.getZ(first + i)) < FLAT));
    const found = isSide
      ? wrapped(corners, box, radius, tile, shape === 'sphere')
      : alongAxis(corners, box, tile);
    uvs.set(found, first * 2);
  }
  geometry.setAttribute('uv', new THREE.BufferAttribute(uvs, 2));
}

type Corners = readonly [THREE.Vector3, THREE.Vector3, THREE.Vector3];

function alongAxis(corners: Corners, { min, max }: THREE.Box3, tile: Tile): number[] {
  const across = new THREE.Vector3()
    .subVectors(corners[1], corners[0])
    .cross(new THREE.Vector3().subVectors(corners[2], corners[0]));
  const [x, y, z] = across.toArray().map(Math.abs) as [number, number, number];
  const axis = x >= y && x >= z ? 'x' : y >= z ? 'y' : 'z';
  const isFront = across[axis] > 0;
  return corners.flatMap((corner) => {
    const v = axis === 'z' ? corner.y - min.y : corner.z - min.z;
    // The picture is mirrored on opposite faces, so that it is never reversed when seen from outside.
    const along = axis === 'x' ? corner.y - min.y : corner.x - min.x;
    const back = axis === 'x' ? max.y - corner.y : max.x - corner.x;
    const u = (axis === 'y') === isFront ? back : along;
    return [u / tile[0], v / tile[1]];
  });
}

function wrapped(
  corners: Corners,
  { min }: THREE.Box3,
  radius: number,
  tile: Tile,
  isBall: boolean,
): number[] {
  const times = Math.max(1, Math.round((TURN * radius) / tile[0]));
  const rounds = Math.max(1, Math.round((Math.PI * radius) / tile[1]));
  const around = corners.map((corner) => Math.hypot(corner.x, corner.y));
  const isPole = around.map((distance) => distance < 1e-6 * Math.max(radius, 1e-9));
  const first = corners.findIndex((_, i) => !isPole[i]);
  const turns = corners.map((corner) => Math.atan2(corner.y, corner.x) / TURN);
  const start = turns[first] ?? 0;
  const near = turns.map((turn) => turn - Math.round(turn - start));
  const known = near.filter((_, i) => !isPole[i]);
  const middle = known.reduce((sum, turn) => sum + turn, 0) / Math.max(known.length, 1);
  return corners.flatMap((corner, i) => {
    const turn = isPole[i] ? middle : (near[i] ?? 0);
    const up = Math.atan2(corner.z, around[i] ?? 0) / Math.PI + 0.5;
    return [turn * times, isBall ? up * rounds : (corner.z - min.z) / tile[1]];
  });
}
