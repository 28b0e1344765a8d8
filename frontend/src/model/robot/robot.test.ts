import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { record, redo, seal, startUndo, undo, type TextUndo } from '../document/undo';
import {
  edited,
  mirrorOf,
  move,
  place,
  setBody,
  setMass,
  setSensor,
  setTrack,
  setValue,
  setWheels,
  turn,
  wheelWidth,
  type RobotEdit,
} from './edits';
import { addBody, removeBody } from './bodies';
import { JOINT_TYPES, setContact, setJoint, setMotor } from './joints';
import { rename } from './names';
import { ADDABLE, addMeshPart, addPart, duplicateParts } from './parts';
import { canRemove, removeParts } from './removal';
import { readRobot, urdfNameOf } from './read';
import { fieldsOf } from './rules';
import { bodiesOf } from './solids';
import { partOf, type Robot } from './types';
import yaml from './template/robot.yaml?raw';
import urdf from './template/robot.urdf?raw';

const texts = <T extends Record<string, string>>(found: T) =>
  Object.fromEntries(Object.entries(found).map(([path, text]) => [path.split('/').at(-2) ?? '', text]));
const configs = texts(
  import.meta.glob<string>('../../../../executor/robots/*/robot.yaml', {
    eager: true,
    query: '?raw',
    import: 'default',
  }),
);
const bodies = texts(
  import.meta.glob<string>('../../../../executor/robots/*/*.urdf', {
    eager: true,
    query: '?raw',
    import: 'default',
  }),
);
const robots: [string, readonly [string, string]][] = [
  ['template', [yaml, urdf]],
  ...Object.keys(configs).map((id): [string, readonly [string, string]] => [
    id,
    [configs[id] ?? '', bodies[id] ?? ''],
  ]),
];

const START: readonly string[] = [yaml, urdf];
const robotOf = ([config = '', body = '']: readonly string[]): Robot => {
  const { robot } = readRobot(config, body);
  if (!robot) throw new Error('no robot');
  return robot;
};
const after = (start: readonly string[], make: (robot: Robot) => RobotEdit): readonly string[] =>
  edited(start, make(robotOf(start)));
const problemsOf = ([config = '', body]: readonly string[]) =>
  readRobot(config, body ?? null).problems.map(({ kind, text, line }) => [kind, text, line]);
const lines = (before: string, now: string) =>
  now.split('\n').filter((line) => !before.split('\n').includes(line));

describe('reading', () => {
  it.each(robots)('finds no problem in %s', (_, both) => {
    expect(problemsOf(both)).toEqual([]);
    const { parts } = robotOf(both);
    expect(parts.map(({ kind }) => kind)).toEqual(
      expect.arrayContaining(['base', 'wheel', 'lidar', 'camera']),
    );
  });

  it('reports problems with their text and line', () => {
    const config = yaml
      .replace('rate_hz: 15', 'rate_hz: 500')
      .replace('link: laser_link', 'link: lasser_link')
      .replace('[wheel_left_joint]', '[wheel]')
      .replace('range_min: 0.12', 'range_min: 9');
    expect(problemsOf([config, urdf])).toEqual([
      ['noJoint', 0, 9],
      ['rangeOrder', 0, 26],
      ['noLinkNear', 0, 28],
      ['range', 0, 43],
    ]);
    expect(problemsOf([yaml])).toEqual([['noUrdf', 0, 6]]);
    expect(problemsOf([yaml.replace('urdf: robot.urdf', 'urdf: robot.xacro')])).toEqual([
      ['otherModel', 0, 6],
    ]);
    const first = (body: string) => problemsOf([yaml, body]).find(([, text]) => text === 1);
    expect(first('<robot>\n<link name="a"></robot>')).toEqual(['xmlClose', 1, 2]);
    expect(first('<robot name="&nope;"/>')?.[0]).toBe('xmlEntity');
    expect(first('<!DOCTYPE robot><robot/>')?.[0]).toBe('xmlDoctype');
    expect(first('<model/>')?.[0]).toBe('notRobot');
    expect(first('<robot><link name="a"/>\n<link name="b"/></robot>')?.[0]).toBe('roots');
    const lost = urdf.replace('<child link="camera_link"/>', '<child link="camera_lnk"/>');
    expect(problemsOf([yaml, lost]).map(([kind]) => kind)).toEqual(['roots', 'jointLinkNear']);
    expect(first(urdf.replace('size="0.3 0.22 0.1"', 'size="0.3 0.22"'))).toEqual(['numbers', 1, 17]);
  });

  it('reads the fields of a sensor from the schema', () => {
    const fields = Object.fromEntries(fieldsOf('camera').map((field) => [field.name, field]));
    expect(fields['width']).toMatchObject({ kind: 'count', fallback: 640, low: 8, high: 4096 });
    expect(fields['depth_topic']).toMatchObject({ kind: 'topic', isOptional: true });
    expect(urdfNameOf(yaml)).toBe('robot.urdf');
  });
});

describe('edits', () => {
  it('moves a sensor, and changes no other byte', () => {
    const [config, body = ''] = after(START, (robot) => move(robot, ['sensor scan'], [0.05, 0, 0.01]));
    expect(config).toBe(yaml);
    expect(body).toBe(urdf.replace('<origin xyz="0 0 0.17"/>', '<origin xyz="0.05 0 0.18"/>'));
    const turned = after(START, (robot) => turn(robot, ['sensor camera'], Math.PI / 2))[1] ?? '';
    expect(turned).toContain('<origin xyz="0.162 0 0.11" rpy="0 0 1.570796"/>');
  });

  it('moves a wheel with the opposite one, and updates the track of the drive', () => {
    const next = after(START, (robot) => move(robot, ['link wheel_left_link'], [0.02, 0.03, 0]));
    const robot = robotOf(next);
    const left = partOf(robot, 'link wheel_left_link');
    expect(left?.pose.slice(0, 3)).toEqual([0.02, 0.16, 0.05]);
    expect(left && mirrorOf(robot, left)?.pose.slice(0, 3)).toEqual([0.02, -0.16, 0.05]);
    expect(robot.track).toBe(0.32);
    expect(
      robotOf(after(next, (now) => setTrack(now, 0.4))).parts.find(({ name }) => name === 'wheel_right_link')
        ?.pose[1],
    ).toBe(-0.2);
  });

  it('makes wheels larger and wider, and keeps them on the floor', () => {
    const robot = robotOf(after(START, (now) => setWheels(now, { radius: 0.075, width: 0.045 })));
    expect(robot.wheelRadius).toBe(0.075);
    expect(wheelWidth(robot)).toBeCloseTo(0.048, 2);
    expect(partOf(robot, 'link wheel_right_link')?.pose[2]).toBeCloseTo(0.075);
    const wheel = robot.urdf.links.get('wheel_left_link');
    expect(wheel?.visuals[1]?.size[0]).toBeCloseTo(0.045);
    expect(wheel?.collisions[0]?.size).toEqual([0.075]);
  });

  it("changes the base's visual, collision and inertia together", () => {
    const next = after(START, (robot) =>
      setBody(robot, 'base_link', 0, { size: [0.4, 0.3, 0.1], color: [1, 0, 0, 1] }),
    );
    const base = robotOf(next).urdf.links.get('base_link');
    expect(base?.collisions[0]?.size).toEqual([0.4, 0.3, 0.1]);
    expect(base?.visuals[0]?.color).toEqual([1, 0, 0, 1]);
    expect(next[1]).toContain('ixx="0.025"');
    const round = robotOf(
      after(next, (robot) => setBody(robot, 'base_link', 0, { shape: 'cylinder' })),
    ).urdf.links.get('base_link');
    expect(round && bodiesOf(round)).toHaveLength(1);
    expect(round?.visuals[0]).toMatchObject({ shape: 'cylinder', size: [0.2, 0.1] });
    const heavy = after(START, (robot) => setMass(robot, 'base_link', 6))[1] ?? '';
    expect(lines(urdf, heavy)).toEqual([
      '      <mass value="6"/>',
      '      <inertia ixx="0.0328" ixy="0" ixz="0" iyy="0.0498" iyz="0" izz="0.0762"/>',
    ]);
  });

  it('adds sensors with free names and topics, and removes them', () => {
    const next = after(START, (robot) => addPart(robot, 'lidar'));
    const robot = robotOf(next);
    expect(problemsOf(next)).toEqual([]);
    expect(robot.sensors.at(-1)).toMatchObject({
      name: 'scan_2',
      link: 'laser_2_link',
      raw: { topic: '/scan_2' },
    });
    expect(after(next, (now) => removeParts(now, ['sensor scan_2']))).toEqual(START);
    const twice = after(START, (now) => duplicateParts(now, ['sensor camera'], [0, 0.1]));
    expect(problemsOf(twice)).toEqual([]);
    expect(robotOf(twice).sensors.at(-1)?.raw).toMatchObject({
      topic: '/camera_2/image_raw',
      info_topic: '/camera_2/camera_info',
    });
  });

  it('sets the values of a sensor and of the drive', () => {
    const far = after(START, (robot) => setSensor(robot, 'sensor scan', 'range_max', 12));
    expect(far[0]).toBe(yaml.replace('range_max: 8.0', 'range_max: 12'));
    expect(after(far, (robot) => setValue(robot, ['drive', 'slip_noise'], undefined))[0]).not.toContain(
      'slip_noise',
    );
  });

  it('sets the type of /cmd_vel, and the ground truth', () => {
    expect(robotOf(START)).toMatchObject({ commandType: 'both', groundTruth: false });
    const stamped = after(START, (robot) => setValue(robot, ['command_type'], 'twist_stamped'));
    const told = after(stamped, (robot) => setValue(robot, ['ground_truth'], true));
    expect(problemsOf(told)).toEqual([]);
    expect(robotOf(told)).toMatchObject({ commandType: 'twist_stamped', groundTruth: true });
    expect(after(told, (robot) => setValue(robot, ['ground_truth'], undefined))).toEqual(stamped);
    expect(problemsOf(after(START, (robot) => setValue(robot, ['command_type'], 'twists')))).toHaveLength(1);
  });

  it('does not remove the base, the wheels and parts that carry others', () => {
    const robot = robotOf(robots.find(([id]) => id === 'lookout')?.[1] ?? START);
    const kept = robot.parts.filter((part) => !canRemove(robot, part)).map(({ name }) => name);
    expect(kept).toEqual(['base_link', 'wheel_left_link', 'wheel_right_link', 'pan_link']);
    expect(
      removeParts(
        robot,
        robot.parts.filter(({ sensor }) => !sensor).map(({ key }) => key),
      ).urdf,
    ).not.toContain('caster');
  });
});

const gesture = fc.tuple(
  fc.nat(14),
  fc.nat(20),
  fc.integer({ min: -40, max: 40 }),
  fc.integer({ min: 1, max: 60 }),
);

const jointAt = ({ urdf }: Robot, pick: number): string =>
  [...urdf.joints.keys()][pick % Math.max(urdf.joints.size, 1)] ?? '';

function editOf(robot: Robot, [kind, pick, a, b]: readonly [number, number, number, number]): RobotEdit {
  const part = robot.parts[pick % robot.parts.length];
  const { key = '', link } = part ?? {};
  switch (kind) {
    case 0:
      return move(robot, [key], [a / 100, b / 100, 0]);
    case 1:
      return turn(robot, [key], a / 20);
    case 2:
      return place(robot, new Map([[key, [a / 100, b / 100, 0.1, a / 30, b / 30, 0]]]));
    case 3:
      return removeParts(robot, [key]);
    case 4:
      return duplicateParts(robot, [key], [0, 0.05]);
    case 5:
      return addPart(robot, ADDABLE[pick % ADDABLE.length] ?? 'lidar');
    case 6:
      return setWheels(robot, { radius: b / 200, width: 0.01 + b / 1000 });
    case 7:
      return setTrack(robot, b / 100);
    case 8:
      return setBody(robot, link ?? '', 0, {
        pose: [0, a / 100, b / 100, 0, 0, 0],
        color: [b / 60, 0, 0, 1],
      });
    case 9:
      return b % 2 ? addBody(robot, link ?? '', 'cylinder') : removeBody(robot, link ?? '', a % 2);
    case 10:
      return rename(robot, 'link', link ?? '', `part_${b}`);
    case 11:
      return rename(robot, 'joint', jointAt(robot, pick), `joint_${b}`);
    case 12:
      return setJoint(robot, jointAt(robot, pick), {
        type: JOINT_TYPES[b % JOINT_TYPES.length] ?? 'fixed',
        axis: [0, a, b],
        limits: [-b, b],
      });
    case 13:
      return a > 0
        ? setMotor(robot, jointAt(robot, pick), b % 4 > 0)
        : setContact(robot, b % 2 ? 'friction' : 'skid', link ?? '', b / 60);
    case 14:
      return b % 2
        ? addMeshPart(robot, { file: `meshes/${b}.stl`, scale: 0.001 })
        : setBody(robot, link ?? '', 0, { shape: 'mesh', file: 'meshes/a.obj' });
    default:
      return setMass(robot, link ?? '', b / 10);
  }
}

describe('any sequence of edits', () => {
  it('keeps both texts valid with their comments, and undoes to the byte', () => {
    const comments = (both: readonly string[]) => both.join('\n').match(/# .*|<!--[^]*?-->/g) ?? [];
    fc.assert(
      fc.property(fc.constantFrom(...robots), fc.array(gesture, { maxLength: 6 }), ([, start], gestures) => {
        let undoStack = startUndo(start);
        for (const each of gestures) {
          const next = edited(undoStack.texts, editOf(robotOf(undoStack.texts), each));
          expect(problemsOf(next)).toEqual([]);
          undoStack = seal(record(undoStack, next, { label: 'x', mergeKey: null, before: [], after: [] }));
        }
        const end = undoStack.texts;
        expect(comments(end)).toEqual(comments(start));
        let steps = 0;
        for (let back: TextUndo | null = undo(undoStack); back; back = undo(back)) {
          undoStack = back;
          steps += 1;
        }
        expect(undoStack.texts).toEqual(start);
        for (; steps > 0; steps -= 1) undoStack = redo(undoStack) ?? undoStack;
        expect(undoStack.texts).toEqual(end);
      }),
      { numRuns: 40 },
    );
  });
});
