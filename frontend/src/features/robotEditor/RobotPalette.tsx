import {
  IconArrowsRight,
  IconBattery3,
  IconCamera,
  IconCompass,
  IconCube,
  IconCylinder,
  IconRadar,
  IconSphere,
  IconStereoGlasses,
} from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { PaletteBar, PlaceButton } from '@/features/editor3d/PlaceButton';
import { ADDABLE, type Addable } from '@/model/robot/parts';
import { placePart } from './commands';
import type { RobotEditor } from './editor';

const ICONS: Readonly<Record<Addable, typeof IconCube>> = {
  lidar: IconRadar,
  camera: IconCamera,
  depth: IconStereoGlasses,
  imu: IconCompass,
  bumper: IconArrowsRight,
  battery: IconBattery3,
  caster: IconSphere,
  box: IconCube,
  cylinder: IconCylinder,
};

/** What can be added to a robot. */
export function RobotPalette({ editor }: { readonly editor: RobotEditor }) {
  const { t } = useTranslation('robotEditor');
  return (
    <PaletteBar label={t('palette')}>
      {ADDABLE.map((kind) => (
        <PlaceButton
          key={kind}
          icon={ICONS[kind]}
          label={t(`kind.${kind}`)}
          testId={`add-${kind}`}
          what={{ kind }}
          onPlace={() => placePart(editor, kind)}
        />
      ))}
    </PaletteBar>
  );
}
