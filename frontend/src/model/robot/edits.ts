import { seenFrom, within } from '../document/frames';
import { sameValue, type Op } from '../document/ops';
import { rewrite } from '../document/rewrite';
import { splicedAll, type Splice } from '../document/splice';
import { valueAt, type Json, type Path, type Pose } from '../document/values';
import { grown, bodiesOf, inertiaOf, solidOf, type Body } from './solids';
import { partOf, type Part, type Robot } from './types';
import { poseOfLink, URDF_SIZES, type Joint, type Link, type UrdfShape } from './urdf';
import { inertiaIn, setColor, setGeometry, setInertial, setOrigin } from './writing';

/** A change of a robot: operations on `robot.yaml`, the new URDF, and the new selection. */
export interface RobotEdit {
  readonly ops: readonly Op[];
  readonly urdf?: string;
  readonly select?: readonly string[];
}

export const NOTHING: RobotEdit = { ops: [] };

/** Returns the two texts of a robot after an edit. */
export function edited([yaml = '', urdf = '']: readonly string[], edit: RobotEdit): readonly string[] {
  return [edit.ops.length > 0 ? rewrite(yaml, edit.ops) : yaml, edit.urdf ?? urdf];
}

const MICRO = 1e6;
export const rounded = (value: number): number => Math.round(value * MICRO) / MICRO + 0;

const spliced = (robot: Robot, splices: readonly Splice[]): string => splicedAll(robot.urdfText, splices);

/** Sets a value of `robot.yaml`; undefined removes it, so that the default applies. */
export function setValue(robot: Robot, path: Path, value: Json | undefined): RobotEdit {
  if (sameValue(valueAt(robot.raw, path), value)) return NOTHING;
  const next = typeof value === 'number' ? rounded(value) : value;
  return { ops: [next === undefined ? { kind: 'unset', path } : { kind: 'set', path, value: next }] };
}

/** Sets a value of a sensor. */
export function setSensor(robot: Robot, key: string, field: string, value: Json | undefined): RobotEdit {
  const sensor = partOf(robot, key)?.sensor;
  if (!sensor) return NOTHING;
  const edit = setValue(robot, ['sensors', sensor.index, field], value);
  return field === 'name' && edit.ops.length > 0 ? { ...edit, select: [`sensor ${String(value)}`] } : edit;
}

/** Returns the joint that places a part; the base and a battery have none. */
export function jointOf(robot: Robot, part: Part): Joint | undefined {
  return part.link === null ? undefined : robot.urdf.above.get(part.link);
}

/** Returns the wheel on the other side that forms a pair with a wheel. */
export function mirrorOf(robot: Robot, part: Part): Part | undefined {
  const joint = jointOf(robot, part)?.name ?? '';
  for (const [own, other] of [
    [robot.left, robot.right],
    [robot.right, robot.left],
  ] as const) {
    const name = other[own.indexOf(joint)];
    if (own.includes(joint) && name !== undefined) {
      const link = robot.urdf.joints.get(name)?.child;
      return robot.parts.find((each) => each.link === link && each.kind === 'wheel');
    }
  }
  return undefined;
}

function moved(robot: Robot, part: Part, pose: Pose): Splice[] {
  const joint = jointOf(robot, part);
  if (!joint) return [];
  const origin = seenFrom(poseOfLink(robot.urdf, joint.parent), pose);
  // The old angle is kept if it differs only by rounding.
  const kept = origin.map((part, at) => {
    const before = joint.origin[at] ?? 0;
    return Math.abs(part - before) < 1e-9 ? before : rounded(part);
  });
  return setOrigin(robot.urdfText, joint.element, kept as unknown as Pose);
}

/** Moves parts to poses in the frame of the root link. When a wheel moves, the opposite wheel follows. */
export function place(robot: Robot, places: ReadonlyMap<string, Pose>): RobotEdit {
  const wanted = new Map<string, Pose>();
  let { track } = robot;
  for (const [key, pose] of places) {
    const part = partOf(robot, key);
    if (!part) continue;
    wanted.set(key, pose);
    const mirror = part.kind === 'wheel' ? mirrorOf(robot, part) : undefined;
    if (!mirror || places.has(mirror.key)) continue;
    const middle = (part.pose[1] + mirror.pose[1]) / 2;
    const [x, y, z] = pose;
    const [, , , roll, pitch, yaw] = mirror.pose;
    wanted.set(mirror.key, [x, 2 * middle - y, z, roll, pitch, yaw]);
    if (Math.abs(y - part.pose[1]) > 1e-9) track = rounded(2 * Math.abs(y - middle));
  }
  const splices = [...wanted].flatMap(([key, pose]) => {
    const part = partOf(robot, key);
    return part && !isCarried(robot, part, wanted) ? moved(robot, part, pose) : [];
  });
  const { ops } = track > 0 ? setValue(robot, ['drive', 'track'], track) : NOTHING;
  return splices.length === 0 && ops.length === 0 ? NOTHING : { ops, urdf: spliced(robot, splices) };
}

/** Returns whether a part already moves with its parent, or with another part of its link. */
function isCarried(robot: Robot, part: Part, wanted: ReadonlyMap<string, Pose>): boolean {
  const own = [...wanted.keys()].map((key) => partOf(robot, key));
  if (own.find((other) => other?.link === part.link) !== part) return true;
  for (let joint = jointOf(robot, part), count = 0; joint && count < 100; count += 1) {
    const { parent } = joint;
    if (own.some((other) => other?.link === parent && jointOf(robot, other))) return true;
    joint = robot.urdf.above.get(parent);
  }
  return false;
}

/** Moves parts by metres. */
export function move(
  robot: Robot,
  keys: readonly string[],
  [dx, dy, dz]: readonly [number, number, number],
): RobotEdit {
  const places = new Map(
    keys.flatMap((key): [string, Pose][] => {
      const part = partOf(robot, key);
      if (!part) return [];
      const [x, y, z, ...turn] = part.pose;
      return [[key, [x + dx, y + dy, z + dz, ...turn]]];
    }),
  );
  return place(robot, places);
}

/** Turns parts by an angle in rad, each about a vertical axis through itself. */
export function turn(robot: Robot, keys: readonly string[], angle: number): RobotEdit {
  const places = new Map(
    keys.flatMap((key): [string, Pose][] => {
      const part = partOf(robot, key);
      if (!part) return [];
      const [x, y, z, ...own] = part.pose;
      const [, , , ...turned] = within([0, 0, 0, 0, 0, angle], [0, 0, 0, ...own]);
      return [[key, [x, y, z, ...turned]]];
    }),
  );
  return place(robot, places);
}

const wheelsOf = (robot: Robot): Link[] =>
  [...robot.left, ...robot.right].flatMap(
    (name) => robot.urdf.links.get(robot.urdf.joints.get(name)?.child ?? '') ?? [],
  );

/** Returns the width of the driven wheels in m: their longest cylinder along the axle. */
export function wheelWidth(robot: Robot): number {
  const [link] = wheelsOf(robot);
  const lengths =
    link?.visuals.filter(({ shape }) => shape === 'cylinder').map(({ size }) => size[1] ?? 0) ?? [];
  return Math.max(0, ...lengths);
}

/** Sets the radius or width of all driven wheels: their shapes, and the values of the drive. */
export function setWheels(
  robot: Robot,
  wish: { readonly radius?: number; readonly width?: number },
): RobotEdit {
  const radius = wish.radius ?? robot.wheelRadius;
  const width = wheelWidth(robot);
  const across = radius / robot.wheelRadius;
  const along = wish.width !== undefined && width > 0 ? wish.width / width : 1;
  if (!(across > 0 && along > 0) || (across === 1 && along === 1)) return NOTHING;
  const splices = wheelsOf(robot).flatMap((link): Splice[] => {
    const joint = robot.urdf.above.get(link.name);
    if (!joint) return [];
    const shapes = [...link.visuals, ...link.collisions].flatMap((solid) => {
      const { size, pose } = grown(solid, joint.axis, along, across);
      return [
        ...setGeometry(robot.urdfText, solid, solid.shape, size),
        ...setOrigin(robot.urdfText, solid.element, pose),
      ];
    });
    const [x, y, z, ...own] = joint.origin;
    const isOnFloor = Math.abs(poseOfLink(robot.urdf, link.name)[2] - robot.wheelRadius) < 2e-3;
    const raised: Pose = [x, y, z + (isOnFloor ? radius - robot.wheelRadius : 0), ...own];
    return [...shapes, ...setOrigin(robot.urdfText, joint.element, raised)];
  });
  return { ops: setValue(robot, ['drive', 'wheel_radius'], radius).ops, urdf: spliced(robot, splices) };
}

/** Sets the distance between the wheels of both sides, in m. */
export function setTrack(robot: Robot, track: number): RobotEdit {
  if (!(track > 0)) return NOTHING;
  const places = new Map<string, Pose>();
  for (const name of robot.left) {
    const part = robot.parts.find(({ link }) => link !== null && link === robot.urdf.joints.get(name)?.child);
    const mirror = part && mirrorOf(robot, part);
    if (!part || !mirror) continue;
    const middle = (part.pose[1] + mirror.pose[1]) / 2;
    const side = part.pose[1] >= mirror.pose[1] ? 0.5 : -0.5;
    const at = ({ pose: [x, , z, ...own] }: Part, y: number): Pose => [x, y, z, ...own];
    places.set(part.key, at(part, middle + side * track));
    places.set(mirror.key, at(mirror, middle - side * track));
  }
  const { urdf } = place(robot, places);
  const { ops } = setValue(robot, ['drive', 'track'], track);
  return { ops, ...(urdf === undefined ? {} : { urdf }) };
}

/** Sets the mass of a link in kg; the distribution of mass stays. */
export function setMass(robot: Robot, name: string, mass: number): RobotEdit {
  const link = robot.urdf.links.get(name);
  if (!link || !(mass > 0) || link.mass === mass) return NOTHING;
  const said = inertiaIn(link);
  const [body] = bodiesOf(link);
  const solid = body
    ? solidOf(body)
    : { shape: 'sphere' as const, size: [0.05], pose: [0, 0, 0, 0, 0, 0] as Pose };
  const scaled = said && link.mass ? said.map((part) => (part * mass) / (link.mass ?? 1)) : null;
  const inertia = (scaled ?? inertiaOf(solid, mass)) as ReturnType<typeof inertiaOf>;
  const at = scaled ? null : solid.pose.slice(0, 3);
  return { ops: [], urdf: spliced(robot, setInertial(robot.urdfText, link, mass, inertia, at)) };
}

interface BodyWish {
  readonly shape?: UrdfShape;
  readonly size?: readonly number[];
  readonly pose?: Pose;
  readonly color?: readonly number[];
  /** The name of the mesh file in the URDF. */
  readonly file?: string;
}

/** Returns a size for another kind of shape, so that the new shape is as large as the old one. */
function sizeAs(shape: UrdfShape, { visual, collision }: Body): number[] {
  const { shape: before, size } = solidOf({ visual, collision });
  if (shape === 'mesh') return [1, 1, 1];
  const [a = 0.1, b = a, c = b] = size;
  const box =
    before === 'box'
      ? [a, b, c]
      : before === 'sphere'
        ? [2 * a, 2 * a, 2 * a]
        : before === 'mesh'
          ? [0.1, 0.1, 0.1]
          : [2 * a, 2 * a, b];
  const [x = 0.1, y = 0.1, z = 0.1] = box.map(rounded);
  if (shape === 'box') return [x, y, z];
  return shape === 'sphere' ? [rounded(Math.max(x, y, z) / 2)] : [rounded(Math.max(x, y) / 2), z];
}

/**
 * Changes a shape of a link, in its visual and its collision element if it has both. The inertia follows if
 * this is the only shape of the link.
 */
export function setBody(robot: Robot, name: string, index: number, wish: BodyWish): RobotEdit {
  const link = robot.urdf.links.get(name);
  const body = link && bodiesOf(link)[index];
  if (!link || !body) return NOTHING;
  const now = solidOf(body);
  const shape = wish.shape ?? now.shape;
  const size = wish.size ?? (shape === now.shape ? now.size : sizeAs(shape, body));
  if (size.length !== URDF_SIZES[shape].length || size.some((part) => !(Math.abs(part) > 0))) return NOTHING;
  const file = wish.file ?? now.file;
  if (shape === 'mesh' && file === '') return NOTHING;
  const pose = wish.pose ?? now.pose;
  const text = robot.urdfText;
  const splices = [body.visual, body.collision].flatMap((solid) =>
    solid ? [...setGeometry(text, solid, shape, size, file), ...setOrigin(text, solid.element, pose)] : [],
  );
  if (wish.color && body.visual)
    splices.push(...setColor(text, body.visual, wish.color, `${name}_color_${index}`));
  const isOnly = body.collision
    ? link.collisions.length === 1
    : link.collisions.length === 0 && link.visuals.length === 1;
  const isForm = wish.shape !== undefined || wish.size !== undefined || wish.pose !== undefined;
  if (isOnly && isForm && link.mass && shape !== 'mesh') {
    const inertia = inertiaOf({ shape, size, pose }, link.mass);
    splices.push(...setInertial(text, link, link.mass, inertia, pose.slice(0, 3)));
  }
  return splices.length === 0 ? NOTHING : { ops: [], urdf: spliced(robot, splices) };
}
