import { Divider, Menu } from '@mantine/core';
import {
  IconBallFootball,
  IconCube,
  IconCylinder,
  IconPackage,
  IconPolygon,
  IconPuzzle,
  IconRobot,
  IconSphere,
  IconSquare,
  IconUpload,
  IconUser,
  IconWall,
} from '@tabler/icons-react';
import { useQuery } from '@tanstack/react-query';
import { useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { api } from '@/api/client';
import { FILES } from '@/model/universe/types';
import { bringMesh, MESH_KINDS } from '@/features/editor3d/upload';
import { choose } from '@/features/editor3d/placing';
import { PaletteBar, PlaceButton, PlaceMenu } from '@/features/editor3d/PlaceButton';
import { ownRobots } from '@/store/dialogs/newRobot';
import { useProjectStore } from '@/store/project';
import { KINDS, placeThing, type Kind, type Placeable } from './commands';
import type { UniverseEditor } from './editor';

const KIND_ICONS: Readonly<Record<Kind, typeof IconCube>> = {
  wall: IconWall,
  box: IconCube,
  cylinder: IconCylinder,
  sphere: IconSphere,
  crate: IconPackage,
  ball: IconBallFootball,
  floor: IconSquare,
  person: IconUser,
  area: IconPolygon,
};

const chooseThing = (editor: UniverseEditor, name: string, what: Placeable) =>
  choose(editor, { name, what, place: () => placeThing(editor, what) });

/**
 * The things that can be placed: after a click a ghost follows the pointer, and a drag places the thing where
 * the pointer is released.
 */
export function Palette({ editor }: { readonly editor: UniverseEditor }) {
  const { t } = useTranslation('universeEditor');
  return (
    <PaletteBar label={t('palette')}>
      {KINDS.map((kind) => {
        return (
          <PlaceButton
            key={kind}
            editor={editor}
            icon={KIND_ICONS[kind]}
            label={t(`kind.${kind}`)}
            testId={`place-${kind}`}
            what={{ kind } satisfies Placeable}
            onPlace={() => placeThing(editor, { kind })}
          />
        );
      })}
      <Divider />
      <RobotMenu editor={editor} />
      <FileMenu editor={editor} />
    </PaletteBar>
  );
}

function RobotMenu({ editor }: { readonly editor: UniverseEditor }) {
  const { t } = useTranslation('universeEditor');
  const robots = useRobots();
  return (
    <PlaceMenu
      editor={editor}
      icon={IconRobot}
      label={t('robots')}
      testId="place-robot"
      position="right-start"
    >
      {robots.map(({ id, name }) => (
        <Menu.Item key={id} onClick={() => chooseThing(editor, name, { kind: 'robot', model: id })}>
          {name}
        </Menu.Item>
      ))}
    </PlaceMenu>
  );
}

/** Returns the robots of the project, and the built-in ones. */
export function useRobots(): readonly { readonly id: string; readonly name: string }[] {
  const files = useProjectStore((state) => state.files);
  const shipped = useQuery({ queryKey: ['robots'], queryFn: api.robots, staleTime: Infinity });
  const own = ownRobots(Object.keys(files));
  return [
    ...own.map((id) => ({ id, name: id })),
    ...(shipped.data ?? []).filter(({ id }) => !own.includes(id)),
  ];
}

const SHAPES = ['mesh', 'urdf', 'sdf'] as const;

function FileMenu({ editor }: { readonly editor: UniverseEditor }) {
  const { t } = useTranslation('universeEditor');
  const input = useRef<HTMLInputElement>(null);
  const files = useProjectStore((state) => state.files);
  const found = Object.keys(files)
    .filter((path) => !path.startsWith('robots/'))
    .flatMap((file) => {
      const shape = SHAPES.find((each) => FILES[each]?.test(file));
      return shape ? [{ file, shape }] : [];
    })
    .sort((a, b) => a.file.localeCompare(b.file));
  return (
    <>
      <PlaceMenu
        editor={editor}
        icon={IconPuzzle}
        label={t('files')}
        testId="place-file"
        position="right-end"
      >
        <Menu.Label>{t(found.length > 0 ? 'filesHere' : 'noFiles')}</Menu.Label>
        {found.map(({ file, shape }) => (
          <Menu.Item key={file} onClick={() => chooseThing(editor, file, { kind: 'file', shape, file })}>
            {file}
          </Menu.Item>
        ))}
        <Menu.Divider />
        <Menu.Item leftSection={<IconUpload size={16} />} onClick={() => input.current?.click()}>
          {t('bringMesh')}
        </Menu.Item>
      </PlaceMenu>
      <input
        ref={input}
        type="file"
        hidden
        accept={MESH_KINDS}
        data-testid="mesh-file"
        onChange={(event) => {
          const [file] = event.currentTarget.files ?? [];
          event.currentTarget.value = '';
          if (!file) return;
          void bringMesh(file, 'assets').then((mesh) => {
            if (mesh) chooseThing(editor, mesh.path, { kind: 'file', shape: 'mesh', file: mesh.path });
          });
        }}
      />
    </>
  );
}
