import { api } from '@/api/client';
import { titleOf } from '@/model/document/glance';
import { rewrite } from '@/model/document/rewrite';
import { urdfNameOf } from '@/model/robot/read';
import templateUrdf from '@/model/robot/template/robot.urdf?raw';
import templateYaml from '@/model/robot/template/robot.yaml?raw';
import { TEMPLATE } from '@/store/dialogs/newRobot';

interface RobotTexts {
  readonly yaml: string;
  readonly urdf: string;
  readonly urdfName: string;
}

/**
 * Returns the files of a new robot, copied from the template or from a built-in robot; its name is that of
 * its folder.
 */
export async function textsOfRobot(base: string, name: string): Promise<RobotTexts> {
  const [yaml, urdf] =
    base === TEMPLATE
      ? [templateYaml, templateUrdf]
      : await Promise.all([api.robotConfig(base), api.robotUrdf(base)]);
  return {
    yaml: rewrite(yaml, [{ kind: 'set', path: ['name'], value: titleOf(name) }]),
    urdf,
    urdfName: urdfNameOf(yaml) || 'robot.urdf',
  };
}
