import type { Splice } from '../document/splice';
import type { Pose } from '../document/values';
import { attribute, child, escaped, type XmlElement } from '../document/xml';
import { append, prepend, replaced, setAttribute } from '../document/xmlEdits';
import type { Inertia } from './solids';
import type { Link, Solid, UrdfShape } from './urdf';

/** Returns a number with at most six decimals, never as minus zero. */
export const written = (value: number): string => String(Math.round(value * 1e6) / 1e6 + 0);
const fine = (value: number): string => String(Number((Math.abs(value) < 1e-12 ? 0 : value).toPrecision(4)));
export const list = (values: readonly number[]): string => values.map(written).join(' ');

const differs = (said: string | undefined, values: readonly number[]): boolean => {
  const now = (said ?? '').trim() === '' ? values.map(() => 0) : (said ?? '').trim().split(/\s+/).map(Number);
  return values.some((value, index) => !(Math.abs(value - (now[index] ?? NaN)) < 5e-7));
};

/** Sets the origin of an element (a joint, a visual …); unchanged attributes keep their notation. */
export function setOrigin(text: string, element: XmlElement, pose: Pose): Splice[] {
  const place = pose.slice(0, 3);
  const turn = pose.slice(3);
  const origin = child(element, 'origin');
  if (!origin) {
    if (!differs('', pose)) return [];
    const rpy = differs('', turn) ? ` rpy="${list(turn)}"` : '';
    return [prepend(text, element, `<origin xyz="${list(place)}"${rpy}/>`)];
  }
  return [
    ...(differs(attribute(origin, 'xyz'), place) ? [setAttribute(text, origin, 'xyz', list(place))] : []),
    ...(differs(attribute(origin, 'rpy'), turn) ? [setAttribute(text, origin, 'rpy', list(turn))] : []),
  ];
}

export function geometryText(shape: UrdfShape, size: readonly number[], file = ''): string {
  const [a = 0.1, b = 0.1] = size;
  if (shape === 'box') return `<box size="${list(size)}"/>`;
  if (shape === 'sphere') return `<sphere radius="${written(a)}"/>`;
  if (shape === 'mesh') return `<mesh filename="${escaped(file)}" scale="${list(size)}"/>`;
  return `<${shape} radius="${written(a)}" length="${written(b)}"/>`;
}

/** Changes the shape or size of a geometry. */
export function setGeometry(
  text: string,
  solid: Solid,
  shape: UrdfShape,
  size: readonly number[],
  file = solid.file,
): Splice[] {
  const geometry = child(solid.element, 'geometry')?.children[0];
  if (!geometry) return [];
  if (shape !== solid.shape) return [replaced(text, geometry, geometryText(shape, size, file))];
  const values: Readonly<Record<UrdfShape, readonly (readonly [string, readonly number[]])[]>> = {
    box: [['size', size]],
    mesh: [['scale', size]],
    sphere: [['radius', size]],
    cylinder: [
      ['radius', size.slice(0, 1)],
      ['length', size.slice(1)],
    ],
    capsule: [
      ['radius', size.slice(0, 1)],
      ['length', size.slice(1)],
    ],
  };
  const named =
    shape === 'mesh' && file !== solid.file ? [setAttribute(text, geometry, 'filename', file)] : [];
  const sized = values[shape]
    .filter(([name, parts]) =>
      attribute(geometry, name) === undefined
        ? shape !== 'mesh' || parts.some((part) => part !== 1)
        : differs(attribute(geometry, name), parts),
    )
    .map(([name, parts]) => setAttribute(text, geometry, name, list(parts)));
  return [...named, ...sized];
}

/** Sets the colour of a shape; a material that others share is not changed. */
export function setColor(text: string, solid: Solid, color: readonly number[], name: string): Splice[] {
  const material = child(solid.element, 'material');
  const own = child(material, 'color');
  if (own) return [setAttribute(text, own, 'rgba', list(color.map((part) => Math.round(part * 1e3) / 1e3)))];
  const made = `<material name="${escaped(name)}"><color rgba="${list(color.map((part) => Math.round(part * 1e3) / 1e3))}"/></material>`;
  return [material ? replaced(text, material, made) : append(text, solid.element, made)];
}

const MOMENTS = ['ixx', 'ixy', 'ixz', 'iyy', 'iyz', 'izz'] as const;

const momentsText = (inertia: Inertia): string =>
  MOMENTS.map((name, index) => `${name}="${fine(inertia[index] ?? 0)}"`).join(' ');

export const inertialText = (mass: number, inertia: Inertia, place: readonly number[] = [0, 0, 0]): string =>
  `<inertial><origin xyz="${list(place)}"/><mass value="${written(mass)}"/><inertia ${momentsText(inertia)}/></inertial>`;

/** Returns the inertia that the URDF states for a link. */
export function inertiaIn(link: Link): Inertia | null {
  const element = child(child(link.element, 'inertial'), 'inertia');
  const values = MOMENTS.map((name) => Number(attribute(element, name) ?? '0'));
  return element && values.every(Number.isFinite) ? (values as unknown as Inertia) : null;
}

/** Sets the mass of a link in kg and its inertia; `place` also sets its centre of mass. */
export function setInertial(
  text: string,
  link: Link,
  mass: number,
  inertia: Inertia,
  place: readonly number[] | null = null,
): Splice[] {
  const inertial = child(link.element, 'inertial');
  const massAt = child(inertial, 'mass');
  const inertiaAt = child(inertial, 'inertia');
  if (!inertial || !massAt || !inertiaAt) {
    const made = inertialText(mass, inertia, place ?? [0, 0, 0]);
    return [inertial ? replaced(text, inertial, made) : prepend(text, link.element, made)];
  }
  const moved = place
    ? setOrigin(text, inertial, [place[0] ?? 0, place[1] ?? 0, place[2] ?? 0, 0, 0, 0])
    : [];
  return [
    ...moved,
    ...(differs(attribute(massAt, 'value'), [mass])
      ? [setAttribute(text, massAt, 'value', written(mass))]
      : []),
    ...MOMENTS.map((name, index) => setAttribute(text, inertiaAt, name, fine(inertia[index] ?? 0))),
  ];
}
