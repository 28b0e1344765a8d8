import { Menu } from '@mantine/core';
import {
  IconArrowsRight,
  IconBattery3,
  IconCamera,
  IconCompass,
  IconCube,
  IconCylinder,
  IconRadar,
  IconSphere,
  IconPuzzle,
  IconStereoGlasses,
  IconUpload,
} from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { choose } from '@/features/editor3d/placing';
import { PaletteBar, PlaceButton, PlaceMenu } from '@/features/editor3d/PlaceButton';
import type { MeshFile } from '@/model/robot/bodies';
import { ADDABLE, type Addable } from '@/model/robot/parts';
import { useProjectStore } from '@/store/project';
import { placePart, type Placeable } from './commands';
import type { RobotEditor } from './editor';
import { meshesOf } from './meshes';
import { useBringMesh } from './useBringMesh';

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

const chooseMesh = (editor: RobotEditor, mesh: MeshFile) =>
  choose(editor, { name: mesh.file, what: { mesh }, place: () => placePart(editor, { mesh }) });

/** The parts that can be added to a robot. */
export function RobotPalette({ editor }: { readonly editor: RobotEditor }) {
  const { t } = useTranslation('robotEditor');
  return (
    <PaletteBar label={t('palette')}>
      {ADDABLE.map((kind) => (
        <PlaceButton
          key={kind}
          editor={editor}
          isPlaceless={kind === 'battery'}
          icon={ICONS[kind]}
          label={t(`kind.${kind}`)}
          testId={`add-${kind}`}
          what={{ kind } satisfies Placeable}
          onPlace={() => placePart(editor, { kind })}
        />
      ))}
      <MeshMenu editor={editor} />
    </PaletteBar>
  );
}

/**
 * The menu that adds visual parts from a mesh: an existing one of the robot, or one that the user uploads.
 */
function MeshMenu({ editor }: { readonly editor: RobotEditor }) {
  const { t } = useTranslation('robotEditor');
  const paths = useProjectStore((state) => state.files);
  const meshes = meshesOf(editor, Object.keys(paths));
  const { ask, input } = useBringMesh(editor, 'part-mesh-file', (mesh) => chooseMesh(editor, mesh));
  return (
    <>
      <PlaceMenu
        editor={editor}
        icon={IconPuzzle}
        label={t('kind.mesh')}
        testId="add-mesh"
        position="right-end"
      >
        <Menu.Label>{t(meshes.length > 0 ? 'meshesHere' : 'noMeshes')}</Menu.Label>
        {meshes.map((file) => (
          <Menu.Item key={file} onClick={() => chooseMesh(editor, { file, scale: 1 })}>
            {file}
          </Menu.Item>
        ))}
        <Menu.Divider />
        <Menu.Item leftSection={<IconUpload size={16} />} onClick={ask}>
          {t('universeEditor:bringMesh')}
        </Menu.Item>
      </PlaceMenu>
      {input}
    </>
  );
}
