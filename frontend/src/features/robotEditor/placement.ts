import type { Placement } from '@/features/editor3d/scene/PlacingTool';
import { partOf } from '@/model/robot/types';
import { placePart, robotWith, type Placeable } from './commands';
import type { RobotEditor } from './editor';
import type { RobotScene } from './RobotScene';

/** Adds parts to a robot; `scene` draws the ghost. */
export function placementOf(editor: RobotEditor, scene: RobotScene): Placement {
  return {
    scene,
    draw: (what) => {
      const made = what ? robotWith(editor, what as Placeable) : null;
      const part = made ? partOf(made.robot, made.key) : undefined;
      scene.showRobot(made?.robot ?? null, part ? [part] : []);
      scene.mark(part ? [part.key] : []);
      if (!part) return null;
      const [x, y, z] = part.pose;
      return { at: [x, y], height: z };
    },
    place: (what, at) => placePart(editor, what as Placeable, at),
  };
}
