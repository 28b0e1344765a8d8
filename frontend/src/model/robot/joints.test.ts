import { describe, expect, it } from 'vitest';
import { addBody } from './bodies';
import { edited, setBody, type RobotEdit } from './edits';
import { contactOf, motorOf, setContact, setJoint, setMotor, setMotorValue } from './joints';
import { nameProblem, rename } from './names';
import { addMeshPart, addPart } from './parts';
import { readRobot } from './read';
import { fieldsOf } from './rules';
import { partOf, type Robot } from './types';
import yaml from './template/robot.yaml?raw';
import urdf from './template/robot.urdf?raw';

type Texts = readonly string[];
const START: Texts = [yaml, urdf];
const robotOf = ([config = '', body = '']: Texts): Robot => {
  const { robot, problems } = readRobot(config, body);
  expect(problems).toEqual([]);
  if (!robot) throw new Error('no robot');
  return robot;
};
const after = (start: Texts, make: (robot: Robot) => RobotEdit): Texts => edited(start, make(robotOf(start)));
const added = (before: Texts, now: Texts) =>
  now
    .join('\n')
    .split('\n')
    .filter((line) => !before.join('\n').includes(line));

describe('names', () => {
  it('renames a link in both texts, and changes nothing else', () => {
    const next = after(START, (robot) => rename(robot, 'link', 'caster_link', 'tail'));
    expect(next.join('\n')).toBe(START.join('\n').replaceAll('caster_link', 'tail'));
    expect(robotOf(next).parts.find(({ kind }) => kind === 'caster')?.name).toBe('tail');
    const base = after(START, (robot) => rename(robot, 'link', 'base_link', 'body'));
    expect(robotOf(base).urdf.root).toBe('body');
    const laser = after(START, (robot) => rename(robot, 'link', 'laser_link', 'lidar_link'));
    expect(partOf(robotOf(laser), 'sensor scan')?.link).toBe('lidar_link');
  });

  it('renames a joint, also in the drive, the motors and other references', () => {
    const more = urdf.replace(
      '</robot>',
      '  <gazebo reference="wheel_left_joint"/>\n  <transmission name="t"><joint name="wheel_left_joint"/></transmission>\n</robot>',
    );
    const next = after([yaml, more], (robot) => rename(robot, 'joint', 'wheel_left_joint', 'left'));
    expect(robotOf(next).left).toEqual(['left']);
    expect(next.join('\n')).toBe(`${yaml}\n${more}`.replaceAll('wheel_left_joint', 'left'));
  });

  it('refuses taken and invalid names', () => {
    const robot = robotOf(START);
    expect(nameProblem(robot, 'link', 'laser_link', 'laser_link')).toBeNull();
    expect(nameProblem(robot, 'link', 'laser_link', 'base_link')).toBe('taken');
    expect(nameProblem(robot, 'joint', 'x', '2 wheels')).toBe('form');
    expect(rename(robot, 'link', 'laser_link', 'base_link')).toEqual({ ops: [] });
    expect(rename(robot, 'link', 'ghost', 'other')).toEqual({ ops: [] });
  });
});

describe('joints', () => {
  it('make a part turn, with an axis and limits, and a motor with a topic', () => {
    const arm = after(START, (robot) => addPart(robot, 'box'));
    const turning = after(arm, (robot) => setJoint(robot, 'part_joint', { type: 'revolute' }));
    expect(robotOf(turning).urdf.joints.get('part_joint')).toMatchObject({
      type: 'revolute',
      axis: [0, 0, 1],
      limits: [-1.570796, 1.570796],
    });
    expect(turning[1]).toContain('<limit lower="-1.570796" upper="1.570796" effort="10" velocity="3"/>');
    const narrow = after(turning, (robot) =>
      setJoint(robot, 'part_joint', { limits: [0, 1], axis: [0, 1, 0] }),
    );
    expect(added(turning, narrow)).toEqual([
      '    <axis xyz="0 1 0"/>',
      '    <limit lower="0" upper="1" effort="10" velocity="3"/>',
    ]);
    const driven = after(narrow, (robot) => setMotor(robot, 'part_joint', true));
    expect(motorOf(robotOf(driven), 'part_joint')?.raw).toMatchObject({ topic: '/part/command' });
    const quick = after(driven, (robot) => setMotorValue(robot, 'part_joint', 'max_rate', 3));
    expect(motorOf(robotOf(quick), 'part_joint')?.raw).toMatchObject({ max_rate: 3 });
    const fixed = after(quick, (robot) => setJoint(robot, 'part_joint', { type: 'fixed' }));
    expect(motorOf(robotOf(fixed), 'part_joint')).toBeNull();
    expect(after(driven, (robot) => setMotor(robot, 'part_joint', false))[0]).not.toContain('part_joint');
    expect(fieldsOf('motor').map(({ name }) => name)).toEqual(['topic', 'max_rate', 'torque', 'start']);
  });

  it('cannot change those of driven wheels, or to invalid values', () => {
    const robot = robotOf(START);
    expect(setJoint(robot, 'wheel_left_joint', { type: 'fixed' })).toEqual({ ops: [] });
    expect(setMotor(robot, 'wheel_left_joint', true)).toEqual({ ops: [] });
    expect(setMotor(robot, 'laser_joint', true)).toEqual({ ops: [] });
    const turning = robotOf(after(START, (now) => setJoint(now, 'laser_joint', { type: 'continuous' })));
    expect(setJoint(turning, 'laser_joint', { axis: [0, 0, 0] })).toEqual({ ops: [] });
    expect(setJoint(turning, 'laser_joint', { type: 'prismatic', limits: [1, 0] })).toEqual({ ops: [] });
  });

  it('returns the friction of a link', () => {
    const robot = robotOf(START);
    expect(contactOf(robot, 'friction', 'caster_link')).toBe(0);
    expect(contactOf(robot, 'friction', 'base_link')).toBe(0.8);
    const rough = after(START, (now) => setContact(now, 'friction', 'caster_link', 0.2));
    expect(rough[0]).toBe(yaml.replace('caster_link: 0.0', 'caster_link: 0.2'));
    const sliding = after(START, (now) => setContact(now, 'skid', 'wheel_left_link', 0.5));
    expect(contactOf(robotOf(sliding), 'skid', 'wheel_left_link')).toBe(0.5);
  });
});

describe('meshes', () => {
  const cup = { file: 'meshes/cup.stl', scale: 0.001 };

  it('are added to a link, or as a separate part', () => {
    const base = after(START, (robot) => addBody(robot, 'base_link', cup));
    const shapes = robotOf(base).urdf.links.get('base_link');
    expect(shapes?.visuals.at(-1)).toMatchObject({
      shape: 'mesh',
      file: cup.file,
      size: [0.001, 0.001, 0.001],
    });
    expect(shapes?.collisions.at(-1)).toMatchObject({ shape: 'mesh', file: cup.file });
    const piece = after(START, (robot) => addMeshPart(robot, cup, [0.1, 0]));
    const link = robotOf(piece).urdf.links.get('cup_link');
    expect(link?.mass).toBe(0.3);
    expect(piece[1]).toContain('ixx="0.0005"');
    const twice = after(piece, (robot) => addMeshPart(robot, { file: '3 d.obj', scale: 1 }));
    expect(robotOf(twice).urdf.links.has('part_3_d_link')).toBe(true);
  });

  it('replace a shape, are exchanged, and are removed', () => {
    const mesh = after(START, (robot) => setBody(robot, 'base_link', 0, { shape: 'mesh', file: cup.file }));
    const seen = (texts: Texts) => robotOf(texts).urdf.links.get('base_link')?.visuals[0];
    expect(seen(mesh)).toMatchObject({ shape: 'mesh', file: cup.file, size: [1, 1, 1] });
    const other = after(mesh, (robot) => setBody(robot, 'base_link', 0, { file: 'b.obj', size: [2, 2, 2] }));
    expect(seen(other)).toMatchObject({ file: 'b.obj', size: [2, 2, 2] });
    expect(robotOf(other).urdf.links.get('base_link')?.collisions[0]).toMatchObject({ file: 'b.obj' });
    const box = after(other, (robot) => setBody(robot, 'base_link', 0, { shape: 'box' }));
    expect(seen(box)).toMatchObject({ shape: 'box', size: [0.1, 0.1, 0.1], file: '' });
    expect(setBody(robotOf(START), 'base_link', 0, { shape: 'mesh' })).toEqual({ ops: [] });
  });
});
