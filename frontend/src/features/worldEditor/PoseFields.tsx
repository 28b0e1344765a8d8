import { useTranslation } from 'react-i18next';
import { place } from '@/model/universe/edits';
import type { Pose } from '@/model/document/values';
import { edit, type UniverseEditor } from './editor';
import { FieldGroup, NumberField } from './fields';

interface PoseFieldsProps {
  readonly editor: UniverseEditor;
  readonly thing: { readonly key: string; readonly pose: Pose };
  /** Robots stand upright: of the angles only the heading is theirs. */
  readonly isUpright?: boolean;
}

const PLACES = ['x', 'y', 'z'] as const;
const ANGLES = ['roll', 'pitch', 'yaw'] as const;
const DEGREES = 180 / Math.PI;

export function PoseFields({ editor, thing, isUpright = false }: PoseFieldsProps) {
  const { t } = useTranslation('worldEditor');
  const set = (index: number, value: number) => {
    const pose = thing.pose.map((part, at) => (at === index ? value : part)) as unknown as Pose;
    edit(editor, 'move', (now) => place(now, new Map([[thing.key, pose]])));
  };
  return (
    <>
      <FieldGroup title={t('place_m')}>
        {PLACES.map((axis, index) => (
          <NumberField
            key={axis}
            label={axis}
            testId={`field-${axis}`}
            value={thing.pose[index] ?? 0}
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
              testId={`field-${axis}`}
              value={Math.round((thing.pose[index + 3] ?? 0) * DEGREES * 100) / 100}
              onCommit={(value) => set(index + 3, value / DEGREES)}
            />
          ),
        )}
      </FieldGroup>
    </>
  );
}
