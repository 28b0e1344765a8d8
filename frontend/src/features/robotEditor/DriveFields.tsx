import { Checkbox, NativeSelect } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import classes from '@/features/editor3d/editor3d.module.css';
import { FieldGroup, NumberField, TextField } from '@/features/editor3d/fields';
import { setTrack, setValue, setWheels, wheelWidth } from '@/model/robot/edits';
import { COMMAND_TYPES, type Robot } from '@/model/robot/types';
import { edit, type RobotEditor } from './editor';
import { ValueFields } from './ValueFields';

interface DriveFieldsProps {
  readonly editor: RobotEditor;
  readonly robot: Robot;
}

/** The fields for the whole robot: name, wheels and drive. */
export function DriveFields({ editor, robot }: DriveFieldsProps) {
  const { t } = useTranslation('robotEditor');
  return (
    <div className={classes['form']} data-testid="robot-fields">
      <TextField
        label={t('name')}
        value={robot.name}
        testId="robot-name"
        problem={(name) => (name.trim() === '' ? t('editor3d:problem.empty') : null)}
        onCommit={(name) => edit(editor, 'name', (now) => setValue(now, ['name'], name))}
      />
      <TextField
        label={t('description')}
        value={robot.description}
        onCommit={(text) => edit(editor, 'name', (now) => setValue(now, ['description'], text))}
      />
      <WheelFields editor={editor} robot={robot} />
      <ValueFields
        kind="drive"
        values={robot.drive}
        without={['wheel_radius', 'track']}
        onChange={(field, value) => edit(editor, 'drive', (now) => setValue(now, ['drive', field], value))}
      />
      <NativeSelect
        size="xs"
        label={t('commandType')}
        data-testid="command-type"
        value={robot.commandType}
        data={COMMAND_TYPES.map((value) => ({ value, label: t(`command.${value}`) }))}
        onChange={({ currentTarget }) =>
          edit(editor, 'drive', (now) => setValue(now, ['command_type'], currentTarget.value))
        }
      />
      <Checkbox
        size="xs"
        label={t('groundTruth')}
        data-testid="ground-truth"
        checked={robot.groundTruth}
        onChange={({ currentTarget }) =>
          edit(editor, 'drive', (now) =>
            setValue(now, ['ground_truth'], currentTarget.checked ? true : undefined),
          )
        }
      />
      <p className={classes['note']}>{t('wholeHint')}</p>
    </div>
  );
}

/** The fields for all driven wheels. */
export function WheelFields({ editor, robot }: DriveFieldsProps) {
  const { t } = useTranslation('robotEditor');
  const width = wheelWidth(robot);
  return (
    <FieldGroup title={t('wheels')}>
      <NumberField
        label={t('radius')}
        testId="wheel-radius"
        value={robot.wheelRadius}
        min={0.005}
        max={2}
        step={0.005}
        onCommit={(radius) => edit(editor, 'wheels', (now) => setWheels(now, { radius }))}
      />
      {width > 0 ? (
        <NumberField
          label={t('width')}
          testId="wheel-width"
          value={width}
          min={0.002}
          max={1}
          step={0.005}
          onCommit={(wish) => edit(editor, 'wheels', (now) => setWheels(now, { width: wish }))}
        />
      ) : null}
      <NumberField
        label={t('track')}
        testId="wheel-track"
        value={robot.track}
        min={0.01}
        max={5}
        step={0.01}
        onCommit={(track) => edit(editor, 'wheels', (now) => setTrack(now, track))}
      />
    </FieldGroup>
  );
}
