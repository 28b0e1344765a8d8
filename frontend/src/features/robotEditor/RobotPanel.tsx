import {
  IconArrowsRight,
  IconBattery3,
  IconBox,
  IconCamera,
  IconCircle,
  IconCompass,
  IconCube,
  IconRadar,
  IconRobot,
  IconSphere,
} from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import classes from '@/features/editor3d/editor3d.module.css';
import { onPanelKey } from '@/features/editor3d/keys';
import { ThingList } from '@/features/editor3d/ThingList';
import { setSensor } from '@/model/robot/edits';
import { rename } from '@/model/robot/names';
import { partOf, type PartKind, type Robot } from '@/model/robot/types';
import { duplicateSelected, removeSelected } from './commands';
import { DriveFields } from './DriveFields';
import { edit, type RobotEditor } from './editor';
import { nameWords, sensorWords } from './naming';
import { PartFields } from './PartFields';

interface RobotPanelProps {
  readonly editor: RobotEditor;
  readonly robot: Robot;
}

const ICONS: Readonly<Record<PartKind, typeof IconBox>> = {
  base: IconCube,
  wheel: IconCircle,
  caster: IconSphere,
  link: IconBox,
  lidar: IconRadar,
  camera: IconCamera,
  imu: IconCompass,
  bumper: IconArrowsRight,
  battery: IconBattery3,
};

/** The list of parts, with the fields of the selected part, or of the whole robot if none is selected. */
export function RobotPanel({ editor, robot }: RobotPanelProps) {
  const { t } = useTranslation('robotEditor');
  const selection = useStore(editor.store, (state) => state.selection);
  const part = selection.length === 1 ? partOf(robot, selection[0] ?? '') : undefined;
  return (
    // The panel handles only undo and redo, when their keys bubble up from the controls inside.
    // eslint-disable-next-line jsx-a11y/no-static-element-interactions
    <div className={classes['panel']} onKeyDown={(event) => onPanelKey(editor, event)}>
      <ThingList
        editor={editor}
        title={t('parts', { count: robot.parts.length })}
        things={robot.parts.map(({ key, name, kind }) => ({ key, name, icon: ICONS[kind] }))}
        whole={{ label: t('whole'), icon: IconRobot }}
        onDuplicate={() => duplicateSelected(editor)}
        onDelete={() => removeSelected(editor)}
        nameProblem={(key, wish) => {
          const { sensor, name } = partOf(robot, key) ?? { sensor: null, name: '' };
          return sensor ? sensorWords(robot, sensor, t)(wish) : nameWords(robot, 'link', name, t)(wish);
        }}
        onRename={(key, wish) =>
          edit(editor, 'name', (now) => {
            const { sensor, name } = partOf(now, key) ?? { sensor: null, name: '' };
            return sensor ? setSensor(now, key, 'name', wish) : rename(now, 'link', name, wish);
          })
        }
      />
      <div className={classes['fields']}>
        {part ? <PartFields key={part.key} editor={editor} robot={robot} part={part} /> : null}
        {selection.length > 1 ? (
          <div className={classes['form']}>
            <p className={classes['note']}>{t('manySelected', { count: selection.length })}</p>
          </div>
        ) : null}
        {selection.length === 0 ? <DriveFields editor={editor} robot={robot} /> : null}
      </div>
    </div>
  );
}
