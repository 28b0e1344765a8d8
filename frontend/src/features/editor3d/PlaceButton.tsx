import { ActionIcon, Menu, Tooltip } from '@mantine/core';
import type { IconCube } from '@tabler/icons-react';
import type { ReactNode } from 'react';
import { useTranslation } from 'react-i18next';
import classes from './editor3d.module.css';

export const DRAGGED = 'application/x-bts-thing';

type Icon = typeof IconCube;

interface PaletteBarProps {
  readonly label: string;
  readonly children: ReactNode;
}

/** A bar at the edge of the view with the things that can be placed. */
export function PaletteBar({ label, children }: PaletteBarProps) {
  return (
    <div className={classes['palette']} role="toolbar" aria-label={label} aria-orientation="vertical">
      {children}
    </div>
  );
}

interface PlaceButtonProps {
  readonly icon: Icon;
  readonly label: string;
  readonly testId: string;
  /** The data that the view receives when the button is dropped on it. */
  readonly what: object;
  readonly onPlace: () => void;
}

/** A button for a thing: a click places it in the middle of the view, a drag places it under the pointer. */
export function PlaceButton({ icon: Icon, label, testId, what, onPlace }: PlaceButtonProps) {
  const { t } = useTranslation('editor3d');
  return (
    <Tooltip label={label} position="right">
      <ActionIcon
        size="lg"
        aria-label={t('place', { what: label })}
        data-testid={testId}
        draggable
        onDragStart={(event) => {
          event.dataTransfer.setData(DRAGGED, JSON.stringify(what));
          event.dataTransfer.effectAllowed = 'copy';
        }}
        onClick={onPlace}
      >
        <Icon size={20} stroke={1.6} />
      </ActionIcon>
    </Tooltip>
  );
}

interface PlaceMenuProps {
  readonly icon: Icon;
  readonly label: string;
  readonly testId: string;
  readonly position: 'right-start' | 'right-end';
  readonly children: ReactNode;
}

/** A button with a menu of several things that can be placed. */
export function PlaceMenu({ icon: Icon, label, testId, position, children }: PlaceMenuProps) {
  return (
    <Menu position={position}>
      <Tooltip label={label} position="right">
        <Menu.Target>
          <ActionIcon size="lg" aria-label={label} data-testid={testId}>
            <Icon size={20} stroke={1.6} />
          </ActionIcon>
        </Menu.Target>
      </Tooltip>
      <Menu.Dropdown>{children}</Menu.Dropdown>
    </Menu>
  );
}
