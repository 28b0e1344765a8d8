import type { Op } from '../document/ops';
import { splicedAll, type Splice } from '../document/splice';
import { isObject, type Json, type JsonObject, type Vector } from '../document/values';
import { child } from '../document/xml';
import { append, setAttribute } from '../document/xmlEdits';
import { NOTHING, rounded, setValue, type RobotEdit } from './edits';
import type { Robot } from './types';
import type { Joint } from './urdf';
import { list } from './writing';

export const JOINT_TYPES = ['fixed', 'revolute', 'continuous', 'prismatic'] as const;
export type JointType = (typeof JOINT_TYPES)[number];

/** Types of joints that a motor can hold in a position. */
export const MOVING: readonly string[] = ['revolute', 'continuous', 'prismatic'];
const LIMITED: readonly string[] = ['revolute', 'prismatic'];

/** The friction of a link that has none in `robot.yaml`. */
export const FRICTION = 0.8;

/** The initial limits of a joint, in rad, or in m for a prismatic one. */
const FIRST_LIMITS: Readonly<Record<string, readonly [number, number]>> = {
  revolute: [-Math.PI / 2, Math.PI / 2],
  prismatic: [0, 0.1],
};

interface JointWish {
  readonly type?: JointType;
  readonly axis?: Vector;
  readonly limits?: readonly [number, number];
}

/** Returns whether the type of a joint can be changed: those of driven wheels cannot. */
export const isFree = ({ left, right }: Robot, { name }: Joint): boolean =>
  !left.includes(name) && !right.includes(name);

/** Changes the type or limits of a joint; a fixed joint loses its motor. */
export function setJoint(robot: Robot, name: string, wish: JointWish): RobotEdit {
  const joint = robot.urdf.joints.get(name);
  if (!joint || !isFree(robot, joint)) return NOTHING;
  const text = robot.urdfText;
  const type = wish.type ?? joint.type;
  const axis = wish.axis ?? (type !== joint.type && !child(joint.element, 'axis') ? UP : undefined);
  const limits = wish.limits ?? (joint.limits ? undefined : FIRST_LIMITS[type]);
  if (axis?.every((part) => part === 0) || (limits && limits[0] > limits[1])) return NOTHING;
  const splices: Splice[] = [];
  if (type !== joint.type) splices.push(setAttribute(text, joint.element, 'type', type));
  const added: string[] = [];
  if (axis && MOVING.includes(type)) written(splices, added, text, joint, 'axis', { xyz: list(axis) });
  if (limits && LIMITED.includes(type)) {
    const [lower = '', upper = ''] = limits.map((limit) => list([limit]));
    const others = child(joint.element, 'limit') ? {} : { effort: '10', velocity: '3' };
    written(splices, added, text, joint, 'limit', { lower, upper, ...others });
  }
  if (added.length > 0) splices.push(append(text, joint.element, added.join('\n')));
  const motor = MOVING.includes(type) ? null : motorOf(robot, name);
  const ops: Op[] = motor ? [{ kind: 'remove', path: ['joints'], indexes: [motor.index] }] : [];
  return splices.length === 0 ? NOTHING : { ops, urdf: splicedAll(text, splices) };
}

const UP: Vector = [0, 0, 1];

/** Changes an attribute of a joint's element, and adds the element if it is missing. */
function written(
  splices: Splice[],
  added: string[],
  text: string,
  joint: Joint,
  tag: string,
  values: Readonly<Record<string, string>>,
): void {
  const element = child(joint.element, tag);
  if (element)
    splices.push(...Object.entries(values).map(([name, value]) => setAttribute(text, element, name, value)));
  else
    added.push(
      `<${tag} ${Object.entries(values)
        .map(([name, value]) => `${name}="${value}"`)
        .join(' ')}/>`,
    );
}

/** Returns the motor of a joint, and its path in `robot.yaml`. */
export function motorOf({ raw }: Robot, joint: string): { index: number; raw: JsonObject } | null {
  const motors = Array.isArray(raw['joints']) ? (raw['joints'] as Json[]) : [];
  const index = motors.findIndex((each) => isObject(each) && each['joint'] === joint);
  const found = motors[index];
  return isObject(found) ? { index, raw: found } : null;
}

/** Adds a motor with its own topic to a joint, or removes it. */
export function setMotor(robot: Robot, name: string, isThere: boolean): RobotEdit {
  const joint = robot.urdf.joints.get(name);
  const motor = motorOf(robot, name);
  if (!joint || isThere === (motor !== null)) return NOTHING;
  if (motor) return { ops: [{ kind: 'remove', path: ['joints'], indexes: [motor.index] }] };
  if (!MOVING.includes(joint.type) || !isFree(robot, joint)) return NOTHING;
  const value = { joint: name, topic: `/${name.replace(/_joint$/, '')}/command`, max_rate: 1, torque: 2 };
  const motors = robot.raw['joints'];
  return {
    ops: [
      Array.isArray(motors)
        ? { kind: 'insert', path: ['joints'], index: motors.length, values: [value] }
        : { kind: 'set', path: ['joints'], value: [value] },
    ],
  };
}

/** Sets a value of a joint's motor. */
export function setMotorValue(robot: Robot, name: string, field: string, value: Json | undefined): RobotEdit {
  const motor = motorOf(robot, name);
  return motor ? setValue(robot, ['joints', motor.index, field], value) : NOTHING;
}

type Contact = 'friction' | 'skid';

/** Returns a contact value of a link: `friction`, or `skid`, the share of the friction that acts sideways. */
export function contactOf({ raw }: Robot, field: Contact, link: string): number {
  const map = raw[field];
  const value = isObject(map) ? map[link] : undefined;
  return typeof value === 'number' ? value : field === 'friction' ? FRICTION : 1;
}

export function setContact(robot: Robot, field: Contact, link: string, value: number): RobotEdit {
  if (!robot.urdf.links.has(link) || contactOf(robot, field, link) === value) return NOTHING;
  return isObject(robot.raw[field])
    ? setValue(robot, [field, link], value)
    : { ops: [{ kind: 'set', path: [field], value: { [link]: rounded(value) } }] };
}
