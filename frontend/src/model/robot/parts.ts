import type { Op } from '../document/ops';
import { splicedAll, type Splice } from '../document/splice';
import { isObject, type Json, type JsonObject, type Pose, type Vector } from '../document/values';
import { escaped } from '../document/xml';
import { append } from '../document/xmlEdits';
import type { MeshFile } from './bodies';
import { NOTHING, rounded, type RobotEdit } from './edits';
import { extentOf, inertiaOf } from './solids';
import { partOf, type Part, type Robot } from './types';
import type { UrdfShape } from './urdf';
import { geometryText, inertialText, list } from './writing';

/** The parts that can be added to a robot. */
export const ADDABLE = [
  'lidar',
  'camera',
  'depth',
  'imu',
  'bumper',
  'battery',
  'caster',
  'box',
  'cylinder',
] as const;
export type Addable = (typeof ADDABLE)[number];

interface Look {
  readonly shape: UrdfShape;
  readonly file?: string;
  readonly size: readonly number[];
  readonly at?: Vector;
  readonly color: readonly number[];
  readonly mass: number;
  readonly isSolid: boolean;
}

const BLACK = [0.1, 0.1, 0.11, 1];
const LOOKS: Readonly<Record<Exclude<Addable, 'battery' | 'bumper'>, Look>> = {
  lidar: { shape: 'cylinder', size: [0.035, 0.04], color: BLACK, mass: 0.1, isSolid: true },
  camera: {
    shape: 'box',
    size: [0.024, 0.09, 0.026],
    at: [-0.012, 0, 0],
    color: BLACK,
    mass: 0.03,
    isSolid: false,
  },
  depth: {
    shape: 'box',
    size: [0.024, 0.09, 0.026],
    at: [-0.012, 0, 0],
    color: BLACK,
    mass: 0.05,
    isSolid: false,
  },
  imu: { shape: 'box', size: [0.02, 0.02, 0.006], color: [0.1, 0.42, 0.28, 1], mass: 0.01, isSolid: false },
  caster: { shape: 'sphere', size: [0.02], color: [0.72, 0.74, 0.77, 1], mass: 0.05, isSolid: true },
  box: { shape: 'box', size: [0.1, 0.1, 0.1], color: [0.82, 0.84, 0.87, 1], mass: 0.3, isSolid: true },
  cylinder: { shape: 'cylinder', size: [0.05, 0.1], color: [0.82, 0.84, 0.87, 1], mass: 0.3, isSolid: true },
};

/** Stems for the names of new links, joints, sensors and topics. */
const STEMS: Readonly<Record<Addable, string>> = {
  lidar: 'laser',
  camera: 'camera',
  depth: 'depth_camera',
  imu: 'imu',
  bumper: 'bumper',
  battery: 'battery',
  caster: 'caster',
  box: 'part',
  cylinder: 'part',
};

function sensorOf(kind: Addable, topic: (wish: string) => string): JsonObject | null {
  switch (kind) {
    case 'lidar':
      return {
        name: 'scan',
        kind,
        topic: topic('/scan'),
        rays: 360,
        range_min: 0.12,
        range_max: 8,
        rate_hz: 10,
      };
    case 'camera': {
      const image = topic('/camera/image_raw');
      return {
        name: kind,
        kind,
        topic: image,
        info_topic: image.replace('image_raw', 'camera_info'),
        width: 640,
        height: 480,
        fov: 1.047,
        rate_hz: 15,
      };
    }
    case 'depth': {
      const image = topic('/depth_camera/image_raw');
      const stem = image.replace(/\/image_raw$/, '');
      return {
        name: 'depth_camera',
        kind: 'camera',
        topic: image,
        info_topic: `${stem}/camera_info`,
        depth_topic: `${stem}/depth/image_raw`,
        depth_info_topic: `${stem}/depth/camera_info`,
        width: 640,
        height: 480,
        fov: 1.047,
        rate_hz: 15,
      };
    }
    case 'imu':
      return { name: kind, kind, topic: topic('/imu'), rate_hz: 30 };
    case 'bumper':
      return { name: kind, kind, topic: topic('/bumper'), rate_hz: 20 };
    case 'battery':
      return { name: kind, kind, topic: topic('/battery_state'), voltage: 14.4, capacity_ah: 4.4 };
    default:
      return null;
  }
}

/** Returns a free name: the wanted one, or one with a number before its suffix. */
function free(wish: string, taken: ReadonlySet<string>, end = ''): string {
  for (let count = 1; ; count += 1) {
    const name = `${wish}${count === 1 ? '' : `_${count}`}${end}`;
    if (!taken.has(name)) return name;
  }
}

const namesIn = (robot: Robot): Set<string> =>
  new Set([...robot.urdf.links.keys(), ...robot.urdf.joints.keys()]);

const topicsIn = (robot: Robot): Set<string> =>
  new Set(
    robot.sensors.flatMap(({ raw }) =>
      Object.entries(raw)
        .filter(([field, value]) => field.endsWith('topic') && typeof value === 'string')
        .map(([, value]) => value as string),
    ),
  );

/** Returns a topic that no sensor uses yet: `/camera/image_raw`, `/camera_2/image_raw`… */
const freeTopic =
  (taken: ReadonlySet<string>) =>
  (wish: string): string => {
    const [, first = '', rest = ''] = /^(\/[^/]+)(.*)$/.exec(wish) ?? [];
    return free(first.replace(/_\d+$/, ''), taken, rest);
  };

/** Returns the text of a link and its joint to the base, to be appended to the URDF. */
function linkText(robot: Robot, link: string, joint: string, pose: Pose, look: Look | null): string {
  const inner = look
    ? [...solidTexts(link, look)]
    : ['  ' + inertialText(0.001, [1e-6, 0, 0, 1e-6, 0, 1e-6])];
  const [x, y, z, ...turn] = pose;
  const rpy = turn.some((part) => part !== 0) ? ` rpy="${list(turn)}"` : '';
  return [
    `<link name="${escaped(link)}">`,
    ...inner,
    '</link>',
    `<joint name="${escaped(joint)}" type="fixed">`,
    `  <parent link="${escaped(robot.urdf.root)}"/><child link="${escaped(link)}"/><origin xyz="${list([x, y, z])}"${rpy}/>`,
    '</joint>',
  ].join('\n');
}

function* solidTexts(
  link: string,
  { shape, size, at = [0, 0, 0], color, mass, isSolid, file }: Look,
): Generator<string> {
  const pose: Pose = [...at, 0, 0, 0];
  const origin = at.some((part) => part !== 0) ? `<origin xyz="${list(at)}"/>` : '';
  const geometry = `${origin}<geometry>${geometryText(shape, size, file)}</geometry>`;
  const material = `<material name="${escaped(link)}_color"><color rgba="${list(color)}"/></material>`;
  // The size of a mesh is known only from its file, so its inertia is that of the default box.
  const solid = shape === 'mesh' ? { ...LOOKS.box, pose } : { shape, size, pose };
  yield `  ${inertialText(mass, inertiaOf(solid, mass), at)}`;
  yield `  <visual>${geometry}${material}</visual>`;
  if (isSolid) yield `  <collision>${geometry}</collision>`;
}

/** Adds a part that is drawn with a mesh; `at` is in the frame of the root link. */
export function addMeshPart(
  robot: Robot,
  { file, scale }: MeshFile,
  at?: readonly [number, number],
): RobotEdit {
  const stem = (file.split('/').at(-1) ?? '').replace(/\.\w+$/, '').replace(/\W/g, '_');
  const wish = /^[A-Za-z]/.test(stem) ? stem.slice(0, 60) : `part_${stem}`.slice(0, 60);
  const taken = namesIn(robot);
  const link = free(wish, taken, '_link');
  const [x, y, z, ...turn] = firstPlace(robot, 'box');
  const pose: Pose = at ? [rounded(at[0]), rounded(at[1]), z, ...turn] : [x, y, z, ...turn];
  const look: Look = { ...LOOKS.box, shape: 'mesh', size: [scale, scale, scale], file };
  const text = linkText(robot, link, free(wish, taken, '_joint'), pose, look);
  const urdf = splicedAll(robot.urdfText, [append(robot.urdfText, robot.urdf.element, text)]);
  return { ops: [], urdf, select: [`link ${link}`] };
}

/**
 * Returns the initial pose of a new part: on top of or in front of the base for a sensor, behind it for a
 * caster.
 */
function firstPlace(robot: Robot, kind: Addable): Pose {
  const base = robot.urdf.links.get(robot.urdf.root);
  const { low, high } = base ? extentOf(base) : { low: [0, 0, 0] as Vector, high: [0, 0, 0] as Vector };
  const middle = (axis: 0 | 1 | 2) => rounded((low[axis] + high[axis]) / 2);
  const at = (x: number, y: number, z: number): Pose => [x, y, Math.round(z * 1e3) / 1e3, 0, 0, 0];
  if (kind === 'camera' || kind === 'depth')
    return at(Math.round((high[0] + 0.025) * 1e3) / 1e3, middle(1), high[2] - 0.02);
  if (kind === 'caster') return at(Math.round((low[0] + 0.03) * 1e3) / 1e3, middle(1), 0.02);
  if (kind === 'bumper' || kind === 'imu') return at(middle(0), middle(1), middle(2));
  return at(middle(0), middle(1), high[2] + (kind === 'lidar' ? 0.02 : 0.05));
}

const insertAt = (robot: Robot, field: string, values: readonly Json[]): Op => {
  const now = robot.raw[field];
  return Array.isArray(now)
    ? { kind: 'insert', path: [field], index: now.length, values }
    : { kind: 'set', path: [field], value: values };
};

/** Adds a sensor, a caster or a body part; `at` is in the frame of the root link. */
export function addPart(robot: Robot, kind: Addable, at?: readonly [number, number]): RobotEdit {
  const sensor = sensorOf(kind, freeTopic(topicsIn(robot)));
  const name = sensor ? free(String(sensor['name']), new Set(robot.sensors.map((each) => each.name))) : '';
  if (kind === 'battery') {
    return { ops: [insertAt(robot, 'sensors', [{ ...sensor, name }])], select: [`sensor ${name}`] };
  }
  const taken = namesIn(robot);
  const link = free(STEMS[kind], taken, '_link');
  const joint = free(STEMS[kind], taken, '_joint');
  const [x, y, z, ...turn] = firstPlace(robot, kind);
  const pose: Pose = at ? [rounded(at[0]), rounded(at[1]), z, ...turn] : [x, y, z, ...turn];
  const text = linkText(robot, link, joint, pose, kind === 'bumper' ? null : LOOKS[kind]);
  const urdf = splicedAll(robot.urdfText, [append(robot.urdfText, robot.urdf.element, text)]);
  if (sensor) {
    const { kind: own, ...rest } = sensor;
    const item = { ...rest, name, kind: own ?? kind, link };
    return { ops: [insertAt(robot, 'sensors', [ordered(item)])], urdf, select: [`sensor ${name}`] };
  }
  if (kind !== 'caster') return { ops: [], urdf, select: [`link ${link}`] };
  const ops: Op[] = [insertAt(robot, 'wheels', [link])];
  ops.push(
    isObject(robot.raw['friction'])
      ? { kind: 'set', path: ['friction', link], value: 0 }
      : { kind: 'set', path: ['friction'], value: { [link]: 0 } },
  );
  return { ops, urdf, select: [`link ${link}`] };
}

/** Returns an entry with its name, kind and link first. */
function ordered({ name = '', kind = '', link, ...rest }: JsonObject): JsonObject {
  return { name, kind, ...(link === undefined ? {} : { link }), ...rest };
}

/** Copies sensors with their links, shifted by an offset in m. */
export function duplicateParts(
  robot: Robot,
  keys: readonly string[],
  [dx, dy]: readonly [number, number],
): RobotEdit {
  const names = new Set(robot.sensors.map((each) => each.name));
  const taken = namesIn(robot);
  const topics = topicsIn(robot);
  const items: JsonObject[] = [];
  const splices: Splice[] = [];
  for (const key of keys) {
    const part = partOf(robot, key);
    if (!part?.sensor) continue;
    const name = free(part.name.replace(/_\d+$/, ''), names);
    names.add(name);
    const link = part.link === null ? null : copiedLink(robot, part, [dx, dy], taken, splices);
    const fields = Object.entries(part.sensor.raw).map(([field, value]): [string, Json] => {
      if (!field.endsWith('topic') || typeof value !== 'string') return [field, value];
      const topic = freeTopic(topics)(value);
      topics.add(topic);
      return [field, topic];
    });
    items.push(ordered({ ...Object.fromEntries(fields), name, ...(link === null ? {} : { link }) }));
  }
  if (items.length === 0) return NOTHING;
  return {
    ops: [insertAt(robot, 'sensors', items)],
    ...(splices.length > 0 ? { urdf: splicedAll(robot.urdfText, splices) } : {}),
    select: items.map(({ name }) => `sensor ${String(name)}`),
  };
}

function copiedLink(
  robot: Robot,
  part: Part,
  [dx, dy]: readonly [number, number],
  taken: Set<string>,
  splices: Splice[],
): string | null {
  const own = robot.urdf.links.get(part.link ?? '');
  const joint = robot.urdf.above.get(part.link ?? '');
  if (!own || !joint) return part.link;
  const link = free(own.name.replace(/(_\d+)?_link$/, ''), taken, '_link');
  const holder = free(own.name.replace(/(_\d+)?_link$/, ''), taken, '_joint');
  taken.add(link).add(holder);
  const { element } = own;
  const name = element.attributes.get('name');
  const text = robot.urdfText.slice(element.start, element.end);
  const copy = name
    ? `${text.slice(0, name.start - element.start)}${escaped(link)}${text.slice(name.end - element.start)}`
    : text;
  const [x, y, z, ...turn] = joint.origin;
  const held = [
    `<joint name="${escaped(holder)}" type="fixed">`,
    `  <parent link="${escaped(joint.parent)}"/><child link="${escaped(link)}"/><origin xyz="${list([x + dx, y + dy, z])}" rpy="${list(turn)}"/>`,
    '</joint>',
  ];
  const last = robot.urdf.element;
  splices.push(append(robot.urdfText, last, `${copy.replace(/\n {2}/g, '\n')}\n${held.join('\n')}`));
  return link;
}
