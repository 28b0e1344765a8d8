import { change, editorFor, textsOf, type Editor } from '@/features/editor3d/editing';
import { edited, type RobotEdit } from '@/model/robot/edits';
import { readRobot, urdfNameOf, type RobotReading } from '@/model/robot/read';
import type { Robot } from '@/model/robot/types';
import { useProjectStore } from '@/store/project';

export const GRIDS = [0, 0.001, 0.005, 0.01, 0.05] as const;

/** The editor of a robot: `robot.yaml` and its URDF. */
export type RobotEditor = Editor;

const folderOf = (path: string): string => path.slice(0, path.lastIndexOf('/') + 1);

/**
 * Returns the path of a robot's URDF, which is relative to its `robot.yaml`; null if the URDF cannot be
 * shown.
 */
export function urdfPathOf(path: string, yaml: string): string | null {
  const name = urdfNameOf(yaml);
  const isOurs = /\.urdf$/i.test(name) && !name.startsWith('/') && !name.split('/').includes('..');
  return isOurs ? `${folderOf(path)}${name}` : null;
}

/**
 * Returns the editor of a robot of the open project. The editor stays when the tab of the robot is closed.
 */
export const editorOf = (path: string): RobotEditor =>
  editorFor(path, {
    pathsOf: (yaml) => {
      const urdf = urdfPathOf(path, yaml);
      return urdf === null ? [] : [urdf];
    },
    keysOf: ([yaml = '', urdf]) => readRobot(yaml, urdf ?? null).robot?.parts.map(({ key }) => key) ?? [],
    grid: 0.005,
  });

/** Returns the current robot, as far as its texts can be read. */
export function readingOf({ path }: RobotEditor): RobotReading {
  const { currentText } = useProjectStore.getState();
  const yaml = currentText(path) ?? '';
  const urdf = urdfPathOf(path, yaml);
  return readRobot(yaml, urdf === null ? null : currentText(urdf));
}

/** Changes the robot as one undo step, which is merged with the last one if that has the same `mergeKey`. */
export function edit(
  editor: RobotEditor,
  label: string,
  make: (robot: Robot) => RobotEdit,
  mergeKey?: string,
): void {
  const { robot } = readingOf(editor);
  if (!robot) return;
  change(
    editor,
    label,
    () => {
      const made = make(robot);
      if (made.ops.length === 0 && made.urdf === undefined) return null;
      return { texts: edited(textsOf(editor), made), select: made.select };
    },
    mergeKey,
  );
}
