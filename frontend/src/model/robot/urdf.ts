import { similarNames } from '../similar';
import { HERE, within } from '../document/frames';
import type { Issue } from '../document/schema';
import type { Pose, Vector } from '../document/values';
import { attribute, child, children, type XmlElement } from '../document/xml';

export type UrdfShape = 'box' | 'cylinder' | 'capsule' | 'sphere' | 'mesh';

/** The labels of the numbers of a size, by shape: keys of texts. */
export const URDF_SIZES: Readonly<Record<UrdfShape, readonly string[]>> = {
  box: ['x', 'y', 'z'],
  cylinder: ['radius', 'length'],
  capsule: ['radius', 'length'],
  sphere: ['radius'],
  mesh: ['scaleX', 'scaleY', 'scaleZ'],
};

/** A visual or collision shape of a link, in the link's frame. */
export interface Solid {
  readonly element: XmlElement;
  readonly shape: UrdfShape;
  readonly size: readonly number[];
  readonly pose: Pose;
  /** Red, green, blue and alpha from 0 to 1. */
  readonly color: readonly number[];
  readonly file: string;
}

export interface Link {
  readonly name: string;
  readonly element: XmlElement;
  readonly mass: number | null;
  readonly visuals: readonly Solid[];
  readonly collisions: readonly Solid[];
}

export interface Joint {
  readonly name: string;
  readonly element: XmlElement;
  readonly type: string;
  readonly parent: string;
  readonly child: string;
  /** The pose in the frame of the parent link. */
  readonly origin: Pose;
  /** The direction of the axis, of length 1. */
  readonly axis: Vector;
  /** The axis as it is written. */
  readonly writtenAxis: Vector;
  /** The limits of the joint, rad or m; null if it has none. */
  readonly limits: readonly [number, number] | null;
}

/** A robot's tree of links. */
export interface Urdf {
  readonly element: XmlElement;
  readonly name: string;
  readonly root: string;
  readonly links: ReadonlyMap<string, Link>;
  readonly joints: ReadonlyMap<string, Joint>;
  /** The joint that attaches each link, except the root. */
  readonly above: ReadonlyMap<string, Joint>;
}

/** A problem of a URDF, with its place in the text. */
export interface UrdfIssue extends Issue {
  readonly offset: number;
}

const LIMITED: ReadonlySet<string> = new Set(['revolute', 'prismatic']);
const JOINT_KINDS: ReadonlySet<string> = new Set([...LIMITED, 'fixed', 'continuous']);

export const GREY: readonly number[] = [0.6, 0.6, 0.6, 1];

/** The problems that are found while a URDF is read. */
class Findings {
  readonly issues: UrdfIssue[] = [];

  add({ start }: XmlElement, kind: string, params: Issue['params'] = {}): void {
    this.issues.push({ path: [], kind, params, offset: start });
  }

  numbers(
    element: XmlElement | undefined,
    name: string,
    fallback: readonly number[],
    isNeeded = false,
  ): number[] {
    const said = attribute(element, name);
    if (!element || (said === undefined && !isNeeded)) return [...fallback];
    const parts = (said ?? '').trim().split(/\s+/).map(Number);
    if (said?.trim() && parts.length === fallback.length && parts.every(Number.isFinite)) return parts;
    this.add(element, 'numbers', { tag: element.tag, name, count: fallback.length, said: said ?? '' });
    return [...fallback];
  }
}

/**
 * Reads a URDF as the simulator does (executor/robots/urdf.py); `urdf` is null if the links are not one tree.
 */
export function readUrdf(root: XmlElement): { urdf: Urdf | null; issues: readonly UrdfIssue[] } {
  const findings = new Findings();
  if (root.tag !== 'robot') {
    findings.add(root, 'notRobot', { tag: root.tag });
    return { urdf: null, issues: findings.issues };
  }
  const colors = new Map(
    children(root, 'material')
      .filter((material) => child(material, 'color'))
      .map((material) => [attribute(material, 'name') ?? '', colorOf(material, findings)]),
  );
  const links = named(root, 'link', findings, (element, name) => linkOf(element, name, colors, findings));
  const joints = named(root, 'joint', findings, (element, name) => jointOf(element, name, findings));
  const above = new Map<string, Joint>();
  for (const joint of joints.values()) {
    for (const name of [joint.parent, joint.child]) {
      if (links.has(name)) continue;
      const [near] = similarNames(name, [...links.keys()], 1);
      findings.add(joint.element, near ? 'jointLinkNear' : 'jointLink', {
        joint: joint.name,
        link: name,
        ...(near ? { near } : {}),
      });
    }
    if (above.has(joint.child)) findings.add(joint.element, 'twoParents', { link: joint.child });
    else above.set(joint.child, joint);
  }
  const roots = [...links.keys()].filter((name) => !above.has(name));
  if (roots.length !== 1) findings.add(root, 'roots', { roots: roots.join(', ') || '–' });
  const [top] = roots;
  const urdf =
    top === undefined
      ? null
      : { element: root, name: attribute(root, 'name') ?? '', root: top, links, joints, above };
  return { urdf, issues: findings.issues };
}

function named<T>(
  root: XmlElement,
  tag: string,
  findings: Findings,
  make: (element: XmlElement, name: string) => T,
): Map<string, T> {
  const found = new Map<string, T>();
  for (const element of children(root, tag)) {
    const name = attribute(element, 'name') ?? '';
    if (name === '') findings.add(element, 'noName', { tag });
    else if (found.has(name)) findings.add(element, 'twice', { tag, name });
    else found.set(name, make(element, name));
  }
  return found;
}

type Colors = ReadonlyMap<string, readonly number[]>;

function linkOf(element: XmlElement, name: string, colors: Colors, findings: Findings): Link {
  const solids = (tag: string) =>
    children(element, tag).flatMap((each) => solidOf(each, colors, findings) ?? []);
  const mass = child(child(element, 'inertial'), 'mass');
  return {
    name,
    element,
    mass: mass ? (findings.numbers(mass, 'value', [0], true)[0] ?? 0) : null,
    visuals: solids('visual'),
    collisions: solids('collision'),
  };
}

function solidOf(element: XmlElement, colors: Colors, findings: Findings): Solid | null {
  const geometry = child(element, 'geometry')?.children[0];
  if (!geometry) {
    findings.add(element, 'noGeometry', { tag: element.tag });
    return null;
  }
  if (!Object.hasOwn(URDF_SIZES, geometry.tag)) {
    findings.add(geometry, 'noShape', { tag: geometry.tag });
    return null;
  }
  const shape = geometry.tag as UrdfShape;
  const material = child(element, 'material');
  const own = material && child(material, 'color') ? colorOf(material, findings) : undefined;
  return {
    element,
    shape,
    size: sizeOf(geometry, shape, findings),
    pose: originOf(element, findings),
    color: own ?? colors.get(attribute(material, 'name') ?? '') ?? GREY,
    file: attribute(geometry, 'filename') ?? '',
  };
}

function sizeOf(geometry: XmlElement, shape: UrdfShape, findings: Findings): number[] {
  const number = (name: string) => findings.numbers(geometry, name, [0.1], true)[0] ?? 0.1;
  if (shape === 'box') return findings.numbers(geometry, 'size', [0.1, 0.1, 0.1], true);
  if (shape === 'sphere') return [number('radius')];
  if (shape === 'mesh') return findings.numbers(geometry, 'scale', [1, 1, 1]);
  return [number('radius'), number('length')];
}

const colorOf = (material: XmlElement, findings: Findings): number[] =>
  findings.numbers(child(material, 'color'), 'rgba', GREY, true);

function originOf(element: XmlElement, findings: Findings): Pose {
  const origin = child(element, 'origin');
  const [x = 0, y = 0, z = 0] = findings.numbers(origin, 'xyz', [0, 0, 0]);
  const [roll = 0, pitch = 0, yaw = 0] = findings.numbers(origin, 'rpy', [0, 0, 0]);
  return [x, y, z, roll, pitch, yaw];
}

function jointOf(element: XmlElement, name: string, findings: Findings): Joint {
  const parent = child(element, 'parent');
  const below = child(element, 'child');
  if (!parent || !below) findings.add(element, 'jointEnds', { joint: name });
  const type = attribute(element, 'type') ?? 'fixed';
  if (!JOINT_KINDS.has(type)) findings.add(element, 'jointType', { joint: name, type });
  const axis = child(element, 'axis');
  const [x = 1, y = 0, z = 0] = findings.numbers(axis, 'xyz', [1, 0, 0]);
  const length = Math.hypot(x, y, z);
  if (axis && length === 0 && type !== 'fixed') findings.add(axis, 'noAxis', { joint: name });
  return {
    name,
    element,
    type,
    parent: attribute(parent, 'link') ?? '',
    child: attribute(below, 'link') ?? '',
    origin: originOf(element, findings),
    axis: length === 0 ? [1, 0, 0] : [x / length, y / length, z / length],
    writtenAxis: [x, y, z],
    limits: limitsOf(element, name, type, findings),
  };
}

/** Returns the limits of a joint, by the rules of ROS's own parser. */
function limitsOf(element: XmlElement, joint: string, type: string, findings: Findings): Joint['limits'] {
  const controller = child(element, 'safety_controller');
  if (controller && attribute(controller, 'k_velocity') === undefined)
    findings.add(controller, 'jointNeeds', { joint, tag: controller.tag, name: 'k_velocity' });
  const limit = child(element, 'limit');
  if (!limit) {
    if (LIMITED.has(type)) findings.add(element, 'noLimit', { joint, type });
    return null;
  }
  for (const name of ['effort', 'velocity']) {
    if (attribute(limit, name) === undefined)
      findings.add(limit, 'jointNeeds', { joint, tag: limit.tag, name });
  }
  const [lower = 0] = findings.numbers(limit, 'lower', [0]);
  const [upper = 0] = findings.numbers(limit, 'upper', [0]);
  if (LIMITED.has(type) && lower > upper) findings.add(limit, 'limitOrder', { joint, lower, upper });
  return [lower, upper];
}

/** Returns the pose of a link in the frame of the root, with all joints at zero. */
export function poseOfLink({ above }: Urdf, link: string): Pose {
  let pose = HERE;
  let name = link;
  for (let count = 0; count < above.size; count += 1) {
    const joint = above.get(name);
    if (!joint) break;
    pose = within(joint.origin, pose);
    name = joint.parent;
  }
  return pose;
}

/** Returns a link and all links below it. */
export function below(urdf: Urdf, link: string): string[] {
  const found = [link];
  for (let at = 0; at < found.length; at += 1) {
    for (const joint of urdf.joints.values()) {
      if (joint.parent === found[at] && !found.includes(joint.child)) found.push(joint.child);
    }
  }
  return found;
}
