import { useTranslation } from 'react-i18next';
import classes from '@/features/editor3d/editor3d.module.css';
import { TextField } from '@/features/editor3d/fields';
import { PoseFields } from '@/features/editor3d/PoseFields';
import { jointOf, place, setSensor } from '@/model/robot/edits';
import type { Part, Robot } from '@/model/robot/types';
import { BodyFields } from './BodyFields';
import { WheelFields } from './DriveFields';
import { edit, type RobotEditor } from './editor';
import { ValueFields } from './ValueFields';

interface PartFieldsProps {
  readonly editor: RobotEditor;
  readonly robot: Robot;
  readonly part: Part;
}

/** Everything that can be said of one part. */
export function PartFields({ editor, robot, part }: PartFieldsProps) {
  const { t } = useTranslation('robotEditor');
  const { key, kind, sensor, link, name } = part;
  const problem = (wish: string) => {
    if (!/^[A-Za-z][A-Za-z0-9_]{0,79}$/.test(wish)) return t('editor3d:problem.name');
    const isTaken = robot.sensors.some((other) => other.name === wish && other.index !== sensor?.index);
    return isTaken ? t('editor3d:problem.sameId', { id: wish }) : null;
  };
  return (
    <div className={classes['form']} data-testid="part-fields" data-part={key}>
      {sensor ? (
        <TextField
          label={`${t('name')} · ${t(`part.${kind}`)}`}
          value={name}
          testId="part-name"
          problem={problem}
          onCommit={(wish) => edit(editor, 'name', (now) => setSensor(now, key, 'name', wish))}
        />
      ) : (
        <p className={classes['note']}>
          {t(`part.${kind}`)} · <code>{name}</code>
        </p>
      )}
      {jointOf(robot, part) ? (
        <PoseFields
          pose={part.pose}
          step={editor.store.getState().grid || 0.001}
          onChange={(pose) => edit(editor, 'move', (now) => place(now, new Map([[key, pose]])))}
        />
      ) : null}
      {kind === 'wheel' ? <WheelFields editor={editor} robot={robot} /> : null}
      {sensor ? (
        <ValueFields
          kind={sensor.kind}
          values={sensor.raw}
          onChange={(field, value) => edit(editor, 'sensor', (now) => setSensor(now, key, field, value))}
        />
      ) : null}
      {link !== null && part.shows === link ? (
        <BodyFields editor={editor} robot={robot} name={link} isSized={kind !== 'wheel'} />
      ) : null}
    </div>
  );
}
