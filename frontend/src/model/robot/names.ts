import type { Op } from '../document/ops';
import { splicedAll, type Splice } from '../document/splice';
import { isObject, type Json, type Path } from '../document/values';
import { attribute, child, children, type XmlElement } from '../document/xml';
import { setAttribute } from '../document/xmlEdits';
import { NOTHING, type RobotEdit } from './edits';
import type { Robot } from './types';

export type Named = 'link' | 'joint';

/** Names that every ROS program accepts. */
const NAME = /^[A-Za-z][A-Za-z0-9_]{0,79}$/;

/** Returns the reason why a link or a joint cannot have this name: `form`, `taken`, or null. */
export function nameProblem(robot: Robot, what: Named, now: string, name: string): 'form' | 'taken' | null {
  if (name === now) return null;
  if (!NAME.test(name)) return 'form';
  return known(robot, what).has(name) ? 'taken' : null;
}

const known = ({ urdf }: Robot, what: Named): ReadonlyMap<string, unknown> =>
  what === 'link' ? urdf.links : urdf.joints;

/** Renames a link or a joint in both texts, with all references. */
export function rename(robot: Robot, what: Named, from: string, to: string): RobotEdit {
  if (from === to || !known(robot, what).has(from) || nameProblem(robot, what, from, to)) return NOTHING;
  const splices = mentions(robot, what, from).map(([element, name]) =>
    setAttribute(robot.urdfText, element, name, to),
  );
  return {
    ops: what === 'link' ? linkOps(robot, from, to) : jointOps(robot, from, to),
    urdf: splicedAll(robot.urdfText, splices satisfies Splice[]),
    ...(what === 'link' && robot.parts.some(({ key }) => key === `link ${from}`)
      ? { select: [`link ${to}`] }
      : {}),
  };
}

/** Returns every attribute in a URDF that refers to a link or a joint. */
function mentions({ urdf }: Robot, what: Named, name: string): [XmlElement, string][] {
  const found: [XmlElement | undefined, string][] = [];
  const add = (element: XmlElement | undefined, attributeName: string) => {
    if (attribute(element, attributeName) === name) found.push([element, attributeName]);
  };
  const joints = children(urdf.element, 'joint');
  if (what === 'link') {
    for (const link of children(urdf.element, 'link')) add(link, 'name');
    for (const joint of joints) for (const end of ['parent', 'child']) add(child(joint, end), 'link');
  } else {
    for (const joint of joints) {
      add(joint, 'name');
      add(child(joint, 'mimic'), 'joint');
    }
    for (const transmission of children(urdf.element, 'transmission'))
      for (const joint of children(transmission, 'joint')) add(joint, 'name');
  }
  // A name in the Gazebo block may be a link or a joint; if both have the name, it is the link.
  if (what === 'link' || !urdf.links.has(name))
    for (const extension of children(urdf.element, 'gazebo')) add(extension, 'reference');
  return found as [XmlElement, string][];
}

function linkOps({ raw, sensors }: Robot, from: string, to: string): Op[] {
  return [
    ...inList(raw['wheels'], ['wheels'], from, to),
    ...['friction', 'skid'].flatMap((field) => asKey(raw[field], field, from, to)),
    ...sensors
      .filter(({ link }) => link === from)
      .map(({ index }): Op => ({ kind: 'set', path: ['sensors', index, 'link'], value: to })),
  ];
}

function jointOps({ raw, drive }: Robot, from: string, to: string): Op[] {
  const driven = Array.isArray(raw['joints']) ? (raw['joints'] as Json[]) : [];
  return [
    ...['left', 'right'].flatMap((side) => inList(drive[side], ['drive', side], from, to)),
    ...driven.flatMap((each, index): Op[] =>
      isObject(each) && each['joint'] === from
        ? [{ kind: 'set', path: ['joints', index, 'joint'], value: to }]
        : [],
    ),
  ];
}

const inList = (list: Json | undefined, path: Path, from: string, to: string): Op[] =>
  Array.isArray(list)
    ? (list as Json[]).flatMap((each, index): Op[] =>
        each === from ? [{ kind: 'set', path: [...path, index], value: to }] : [],
      )
    : [];

function asKey(map: Json | undefined, field: string, from: string, to: string): Op[] {
  if (!isObject(map) || !Object.hasOwn(map, from)) return [];
  return [{ kind: 'rename', path: [field, from], to }];
}
