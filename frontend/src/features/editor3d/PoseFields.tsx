import { useTranslation } from 'react-i18next';
import type { Pose } from '@/model/document/values';
import { FieldGroup, NumberField } from './fields';

interface PoseFieldsProps {
  readonly pose: Pose;
  /** Whether only the heading can be changed, not roll and pitch. */
  readonly isUpright?: boolean;
  readonly step?: number;
  /** The prefix of the test ids of the fields. */
  readonly testId?: string;
  readonly onChange: (pose: Pose) => void;
}

const PLACES = ['x', 'y', 'z'] as const;
const ANGLES = ['roll', 'pitch', 'yaw'] as const;
const DEGREES = 180 / Math.PI;

/** Fields for a position in m and an orientation in degrees. */
export function PoseFields({ pose, isUpright = false, step, testId = 'field', onChange }: PoseFieldsProps) {
  const { t } = useTranslation('editor3d');
  const set = (index: number, value: number) =>
    onChange(pose.map((part, at) => (at === index ? value : part)) as unknown as Pose);
  return (
    <>
      <FieldGroup title={t('place_m')}>
        {PLACES.map((axis, index) => (
          <NumberField
            key={axis}
            label={axis}
            testId={`${testId}-${axis}`}
            value={pose[index] ?? 0}
            {...(step === undefined ? {} : { step })}
            onCommit={(value) => set(index, value)}
          />
        ))}
      </FieldGroup>
      <FieldGroup title={t('angles')}>
        {ANGLES.map((axis, index) =>
          isUpright && axis !== 'yaw' ? null : (
            <NumberField
              key={axis}
              label={axis}
              step={15}
              testId={`${testId}-${axis}`}
              value={Math.round((pose[index + 3] ?? 0) * DEGREES * 100) / 100}
              onCommit={(value) => set(index + 3, value / DEGREES)}
            />
          ),
        )}
      </FieldGroup>
    </>
  );
}
