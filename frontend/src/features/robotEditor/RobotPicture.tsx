import { useEffect, useLayoutEffect, useMemo, useReducer } from 'react';
import { Picture3d, PictureStage } from '@/features/editor3d/scene/Picture3d';
import { isSoftwareWebGl } from '@/features/viewer/webgl';
import { readRobot } from '@/model/robot/read';
import type { Robot } from '@/model/robot/types';
import { useFileText } from '@/store/saving/large';
import { urdfPathOf } from './editor';
import { urdfFolder } from './meshes';
import { RobotScene } from './RobotScene';

const GROUND = { color: [0.85, 0.83, 0.8] };
const SUN = [{ direction: [0.3, 0.4, -0.8], intensity: 1 }];

/** A picture of a robot of the project; nothing if the page cannot read it. */
export function RobotPicture({ path }: { readonly path: string }) {
  const yaml = useFileText(path) ?? '';
  const urdf = useFileText(urdfPathOf(path, yaml));
  const robot = useMemo(() => readRobot(yaml, urdf).robot, [yaml, urdf]);
  if (!robot) return null;
  const folder = urdfFolder({ path });
  return (
    <Picture3d
      label={robot.name}
      near={0.01}
      stage={(isDark) => <Stage robot={robot} folder={folder} isDark={isDark} />}
    />
  );
}

interface StageProps {
  readonly robot: Robot;
  readonly folder: string;
  readonly isDark: boolean;
}

function Stage({ robot, folder, isDark }: StageProps) {
  const [arrivals, arrive] = useReducer((count: number) => count + 1, 0);
  const scene = useMemo(() => new RobotScene(isSoftwareWebGl(), arrive, folder), [folder]);
  useLayoutEffect(() => scene.showRobot(robot), [scene, robot]);
  useEffect(() => () => scene.dispose(), [scene]);
  return (
    <PictureStage
      scene={scene}
      request={arrivals}
      isDark={isDark}
      lights={SUN}
      ground={GROUND}
      reach={[0.1, 12]}
      extent={[0.55, 6]}
    />
  );
}
