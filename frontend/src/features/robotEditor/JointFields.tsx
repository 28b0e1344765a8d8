import { Select, Switch } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import classes from '@/features/editor3d/editor3d.module.css';
import { FieldGroup, NumberField, TextField } from '@/features/editor3d/fields';
import { isReadOnly } from '@/features/editor3d/editing';
import {
  isFree,
  JOINT_TYPES,
  motorOf,
  MOVING,
  setJoint,
  setMotor,
  setMotorValue,
  type JointType,
} from '@/model/robot/joints';
import { rename } from '@/model/robot/names';
import type { Robot } from '@/model/robot/types';
import type { Joint } from '@/model/robot/urdf';
import { edit, type RobotEditor } from './editor';
import { nameWords } from './naming';
import { ValueFields } from './ValueFields';

interface JointFieldsProps {
  readonly editor: RobotEditor;
  readonly robot: Robot;
  readonly joint: Joint;
}

const AXES = ['x', 'y', 'z'] as const;
const ENDS = ['lower', 'upper'] as const;
const DEGREES = 180 / Math.PI;

/** The fields for the joint between a part and its parent: its type, its axis and its motor. */
export function JointFields({ editor, robot, joint }: JointFieldsProps) {
  const { t } = useTranslation('robotEditor');
  const { name, type } = joint;
  const moves = MOVING.includes(type);
  const kinds = [...new Set<string>([...JOINT_TYPES, type])];
  return (
    <details className={classes['piece']} open={moves && isFree(robot, joint)} data-testid="joint">
      <summary>
        {t('joint')} · {t(`jointType.${type}`, { defaultValue: type })}
      </summary>
      <div className={classes['pieceForm']}>
        <TextField
          label={t('jointName')}
          testId="joint-name"
          value={name}
          problem={nameWords(robot, 'joint', name, t)}
          onCommit={(wish) => edit(editor, 'name', (now) => rename(now, 'joint', name, wish))}
        />
        {isFree(robot, joint) ? (
          <Select
            size="xs"
            label={t('moves')}
            data-testid="joint-type"
            value={type}
            disabled={isReadOnly()}
            allowDeselect={false}
            data={kinds.map((value) => ({ value, label: t(`jointType.${value}`, { defaultValue: value }) }))}
            onChange={(value) => {
              if (value) edit(editor, 'joint', (now) => setJoint(now, name, { type: value as JointType }));
            }}
          />
        ) : null}
        {moves && isFree(robot, joint) ? <Motion editor={editor} robot={robot} joint={joint} /> : null}
      </div>
    </details>
  );
}

function Motion({ editor, robot, joint }: JointFieldsProps) {
  const { t } = useTranslation('robotEditor');
  const { name, type, writtenAxis: axis, limits } = joint;
  const motor = motorOf(robot, name);
  const factor = type === 'prismatic' ? 1 : DEGREES;
  const unit = type === 'prismatic' ? 'm' : '°';
  return (
    <>
      <FieldGroup title={t('axis')}>
        {AXES.map((label, at) => (
          <NumberField
            key={label}
            label={label}
            testId={`joint-axis-${label}`}
            value={axis[at] ?? 0}
            min={-1}
            max={1}
            step={0.5}
            onCommit={(value) => {
              const [x, y, z] = axis.map((part, each) => (each === at ? value : part));
              edit(editor, 'joint', (now) => setJoint(now, name, { axis: [x ?? 0, y ?? 0, z ?? 0] }));
            }}
          />
        ))}
      </FieldGroup>
      {type === 'continuous' ? null : (
        <FieldGroup title={t('limits', { unit })} columns={2}>
          {ENDS.map((end, at) => (
            <NumberField
              key={end}
              label={t(`limit.${end}`)}
              testId={`joint-${end}`}
              value={(limits?.[at] ?? 0) * factor}
              min={at === 0 ? -1e4 : (limits?.[0] ?? 0) * factor}
              max={at === 0 ? (limits?.[1] ?? 0) * factor : 1e4}
              isAngle={factor > 1}
              step={factor > 1 ? 5 : 0.01}
              onCommit={(value) => {
                const [lower, upper] = limits ?? [0, 0];
                const wish = value / factor;
                // A limit that is set to the value of the other one may exceed it, because values are rounded
                // for display.
                const next: [number, number] =
                  at === 0 ? [Math.min(wish, upper), upper] : [lower, Math.max(wish, lower)];
                edit(editor, 'joint', (now) => setJoint(now, name, { limits: next }));
              }}
            />
          ))}
        </FieldGroup>
      )}
      <Switch
        size="xs"
        label={t('motor')}
        description={t('motorHint')}
        data-testid="joint-motor"
        checked={motor !== null}
        disabled={isReadOnly()}
        onChange={(event) => {
          const isThere = event.currentTarget.checked;
          edit(editor, 'motor', (now) => setMotor(now, name, isThere));
        }}
      />
      {motor ? (
        <ValueFields
          kind="motor"
          values={motor.raw}
          onChange={(field, value) => edit(editor, 'motor', (now) => setMotorValue(now, name, field, value))}
        />
      ) : null}
    </>
  );
}
