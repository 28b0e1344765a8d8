import { useTranslation } from 'react-i18next';
import classes from '@/features/editor3d/editor3d.module.css';
import { TextField } from '@/features/editor3d/fields';
import { PoseFields } from '@/features/editor3d/PoseFields';
import { jointOf, place, setSensor } from '@/model/robot/edits';
import type { Part, Robot } from '@/model/robot/types';
import { rename } from '@/model/robot/names';
import { BodyFields } from './BodyFields';
import { WheelFields } from './DriveFields';
import { edit, type RobotEditor } from './editor';
import { JointFields } from './JointFields';
import { nameWords, sensorWords } from './naming';
import { ValueFields } from './ValueFields';

interface PartFieldsProps {
  readonly editor: RobotEditor;
  readonly robot: Robot;
  readonly part: Part;
}

/** The fields for all properties of a part. */
export function PartFields({ editor, robot, part }: PartFieldsProps) {
  const { t } = useTranslation('robotEditor');
  const { key, kind, sensor, link, name } = part;
  const joint = jointOf(robot, part);
  return (
    <div className={classes['form']} data-testid="part-fields" data-part={key}>
      {sensor ? (
        <TextField
          label={`${t('name')} · ${t(`part.${kind}`)}`}
          value={name}
          testId="part-name"
          problem={sensorWords(robot, sensor, t)}
          onCommit={(wish) => edit(editor, 'name', (now) => setSensor(now, key, 'name', wish))}
        />
      ) : (
        <TextField
          label={`${t('name')} · ${t(`part.${kind}`)}`}
          value={name}
          testId="part-name"
          problem={nameWords(robot, 'link', name, t)}
          onCommit={(wish) => edit(editor, 'name', (now) => rename(now, 'link', name, wish))}
        />
      )}
      {joint ? (
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
      {joint ? <JointFields key={joint.name} editor={editor} robot={robot} joint={joint} /> : null}
    </div>
  );
}
