import { splicedAll } from '../document/splice';
import { escaped } from '../document/xml';
import { append, removed } from '../document/xmlEdits';
import { NOTHING, rounded, type RobotEdit } from './edits';
import { bodiesOf, extentOf } from './solids';
import type { Robot } from './types';
import { geometryText, list } from './writing';

/** A mesh file beside the URDF, and the length of its unit in m. */
export interface MeshFile {
  readonly file: string;
  readonly scale: number;
}

/** Adds a visual and collision shape to a link. */
export function addBody(
  robot: Robot,
  name: string,
  shape: 'box' | 'cylinder' | 'sphere' | MeshFile,
): RobotEdit {
  const link = robot.urdf.links.get(name);
  if (!link) return NOTHING;
  const { high } = extentOf(link);
  const geometry =
    typeof shape === 'string'
      ? `<origin xyz="${list([0, 0, rounded(high[2] + 0.05)])}"/><geometry>${geometryText(shape, SIZES[shape])}</geometry>`
      : `<geometry>${meshText(shape)}</geometry>`;
  const material = `<material name="${escaped(name)}_color_${bodiesOf(link).length}"><color rgba="${list([0.82, 0.84, 0.87, 1])}"/></material>`;
  const text = `<visual>${geometry}${material}</visual>\n<collision>${geometry}</collision>`;
  return { ops: [], urdf: splicedAll(robot.urdfText, [append(robot.urdfText, link.element, text)]) };
}

const SIZES = { box: [0.1, 0.1, 0.1], cylinder: [0.05, 0.1], sphere: [0.05] } as const;

const meshText = ({ file, scale }: MeshFile): string => geometryText('mesh', [scale, scale, scale], file);

/** Removes a shape of a link, except the last visual shape of the base. */
export function removeBody(robot: Robot, name: string, index: number): RobotEdit {
  const link = robot.urdf.links.get(name);
  const body = link && bodiesOf(link)[index];
  if (!link || !body || (name === robot.urdf.root && bodiesOf(link).length === 1)) return NOTHING;
  const splices = [body.visual, body.collision].flatMap((solid) =>
    solid ? [removed(robot.urdfText, solid.element)] : [],
  );
  return { ops: [], urdf: splicedAll(robot.urdfText, splices) };
}
