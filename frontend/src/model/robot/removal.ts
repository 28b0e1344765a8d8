import type { Op } from '../document/ops';
import { splicedAll } from '../document/splice';
import { isObject, valueAt, type Json } from '../document/values';
import { removed } from '../document/xmlEdits';
import { NOTHING, type RobotEdit } from './edits';
import { partOf, type Part, type Robot } from './types';
import { below } from './urdf';

/** Returns whether a part can be removed: not the base, a driven wheel, or a part that carries others. */
export function canRemove(robot: Robot, part: Part): boolean {
  if (part.kind === 'base' || part.kind === 'wheel') return false;
  return part.sensor !== null || (part.link !== null && below(robot.urdf, part.link).length === 1);
}

/** Removes parts, and their entries in `robot.yaml`. */
export function removeParts(robot: Robot, keys: readonly string[]): RobotEdit {
  const parts = keys.flatMap((key) => partOf(robot, key) ?? []).filter((part) => canRemove(robot, part));
  const gone = new Set(parts.map(({ key }) => key));
  const links = new Set(
    parts.flatMap(({ link }) => (link !== null && !isNeeded(robot, link, gone) ? [link] : [])),
  );
  const splices = [...links].flatMap((name) => {
    const link = robot.urdf.links.get(name);
    const joint = robot.urdf.above.get(name);
    return [link, joint].flatMap((each) => (each ? [removed(robot.urdfText, each.element)] : []));
  });
  const sensors = parts.flatMap(({ sensor }) => (sensor ? [sensor.index] : []));
  const ops: Op[] = sensors.length > 0 ? [{ kind: 'remove', path: ['sensors'], indexes: sensors }] : [];
  ops.push(...forgotten(robot, links));
  if (ops.length === 0 && splices.length === 0) return NOTHING;
  return { ops, ...(splices.length > 0 ? { urdf: splicedAll(robot.urdfText, splices) } : {}), select: [] };
}

/**
 * Returns whether a link must stay when one of its parts is removed: other links or parts are attached to it.
 */
function isNeeded(robot: Robot, link: string, gone: ReadonlySet<string>): boolean {
  if (link === robot.urdf.root || below(robot.urdf, link).length > 1) return true;
  return robot.parts.some((part) => part.link === link && !gone.has(part.key));
}

/** Removes deleted links from the lists in `robot.yaml`. */
function forgotten(robot: Robot, links: ReadonlySet<string>): Op[] {
  const listed = (field: string, nameOf: (item: Json) => Json | undefined): Op[] => {
    const items = robot.raw[field];
    if (!Array.isArray(items)) return [];
    const indexes = (items as Json[]).flatMap((item, index) => {
      const name = nameOf(item);
      return typeof name === 'string' && links.has(name) ? [index] : [];
    });
    return indexes.length > 0 ? [{ kind: 'remove', path: [field], indexes }] : [];
  };
  const mapped = (field: string): Op[] => {
    const map = robot.raw[field];
    const names = isObject(map) ? Object.keys(map).filter((name) => links.has(name)) : [];
    if (isObject(map) && names.length > 0 && names.length === Object.keys(map).length)
      return [{ kind: 'unset', path: [field] }];
    return names.map((name) => ({ kind: 'unset', path: [field, name] }));
  };
  return [
    ...listed('wheels', (item) => item),
    ...listed('joints', (item) => robot.urdf.joints.get(String(valueAt(item, ['joint'])))?.child),
    ...mapped('friction'),
    ...mapped('skid'),
  ];
}
