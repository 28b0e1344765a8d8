import { ActionIcon, Divider, Menu, Tooltip } from '@mantine/core';
import {
  IconBallFootball,
  IconCube,
  IconCylinder,
  IconPackage,
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
import { useProjectStore } from '@/store/project';
import { KINDS, placeThing, type Kind, type Placeable } from './commands';
import type { UniverseEditor } from './editor';
import { bringMesh, MESH_KINDS } from './upload';
import classes from './worldEditor.module.css';

export const DRAGGED = 'application/x-bts-thing';

export const KIND_ICONS: Readonly<Record<Kind, typeof IconCube>> = {
  wall: IconWall,
  box: IconCube,
  cylinder: IconCylinder,
  sphere: IconSphere,
  crate: IconPackage,
  ball: IconBallFootball,
  floor: IconSquare,
  person: IconUser,
};

/** Things to place: clicked, they come to stand in the middle of the view; dragged, where they are let go. */
export function Palette({ editor }: { readonly editor: UniverseEditor }) {
  const { t } = useTranslation('worldEditor');
  return (
    <div className={classes['palette']} role="toolbar" aria-label={t('palette')} aria-orientation="vertical">
      {KINDS.map((kind) => {
        const Icon = KIND_ICONS[kind];
        return (
          <Tooltip key={kind} label={t(`kind.${kind}`)} position="right">
            <ActionIcon
              size="lg"
              aria-label={t('place', { what: t(`kind.${kind}`) })}
              data-testid={`place-${kind}`}
              draggable
              onDragStart={(event) => {
                event.dataTransfer.setData(DRAGGED, JSON.stringify({ kind } satisfies Placeable));
                event.dataTransfer.effectAllowed = 'copy';
              }}
              onClick={() => placeThing(editor, { kind })}
            >
              <Icon size={20} stroke={1.6} />
            </ActionIcon>
          </Tooltip>
        );
      })}
      <Divider />
      <RobotMenu editor={editor} />
      <FileMenu editor={editor} />
    </div>
  );
}

function RobotMenu({ editor }: { readonly editor: UniverseEditor }) {
  const { t } = useTranslation('worldEditor');
  const robots = useRobots();
  return (
    <Menu position="right-start">
      <Tooltip label={t('robots')} position="right">
        <Menu.Target>
          <ActionIcon size="lg" aria-label={t('robots')} data-testid="place-robot">
            <IconRobot size={20} stroke={1.6} />
          </ActionIcon>
        </Menu.Target>
      </Tooltip>
      <Menu.Dropdown>
        {robots.map(({ id, name }) => (
          <Menu.Item key={id} onClick={() => placeThing(editor, { kind: 'robot', model: id })}>
            {name}
          </Menu.Item>
        ))}
      </Menu.Dropdown>
    </Menu>
  );
}

/** Robots of the project and those that we ship. */
export function useRobots(): readonly { readonly id: string; readonly name: string }[] {
  const files = useProjectStore((state) => state.files);
  const shipped = useQuery({ queryKey: ['robots'], queryFn: api.robots, staleTime: Infinity });
  const own = Object.keys(files)
    .map((path) => /^robots\/([^/]+)\/robot\.yaml$/.exec(path)?.[1])
    .filter((id) => id !== undefined);
  return [
    ...own.map((id) => ({ id, name: id })),
    ...(shipped.data ?? []).filter(({ id }) => !own.includes(id)),
  ];
}

const SHAPES = ['mesh', 'urdf', 'sdf'] as const;

function FileMenu({ editor }: { readonly editor: UniverseEditor }) {
  const { t } = useTranslation('worldEditor');
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
      <Menu position="right-end">
        <Tooltip label={t('files')} position="right">
          <Menu.Target>
            <ActionIcon size="lg" aria-label={t('files')} data-testid="place-file">
              <IconPuzzle size={20} stroke={1.6} />
            </ActionIcon>
          </Menu.Target>
        </Tooltip>
        <Menu.Dropdown>
          <Menu.Label>{t(found.length > 0 ? 'filesHere' : 'noFiles')}</Menu.Label>
          {found.map(({ file, shape }) => (
            <Menu.Item key={file} onClick={() => placeThing(editor, { kind: 'file', shape, file })}>
              {file}
            </Menu.Item>
          ))}
          <Menu.Divider />
          <Menu.Item leftSection={<IconUpload size={16} />} onClick={() => input.current?.click()}>
            {t('bringMesh')}
          </Menu.Item>
        </Menu.Dropdown>
      </Menu>
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
          void bringMesh(file).then((path) => {
            if (path) placeThing(editor, { kind: 'file', shape: 'mesh', file: path });
          });
        }}
      />
    </>
  );
}
