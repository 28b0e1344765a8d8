import { ActionIcon, Menu, Tooltip } from '@mantine/core';
import type { IconCube } from '@tabler/icons-react';
import type { PointerEvent, ReactNode } from 'react';
import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import classes from './editor3d.module.css';
import type { Editor } from './editing';
import { choose, dragFrom } from './placing';

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
  readonly editor: Editor;
  readonly icon: Icon;
  readonly label: string;
  readonly testId: string;
  /** The value that the view places. */
  readonly what: object;
  /** Places it without a ghost. */
  readonly onPlace: () => void;
  /** Whether the thing has no pose, and therefore no ghost. */
  readonly isPlaceless?: boolean;
}

/**
 * A button for a thing: after a click its ghost follows the pointer; a drag places it where the pointer is
 * released. It waits for the view: before, the keyboard would stay on the button, and Enter would give up what
 * was just chosen.
 */
export function PlaceButton(props: PlaceButtonProps) {
  const { editor, icon: Icon, label, testId, what, onPlace, isPlaceless = false } = props;
  const { t } = useTranslation('editor3d');
  const isChosen = useStore(editor.store, (state) => state.placing?.name === label);
  const canPlace = useStore(editor.store, (state) => state.canPlace);
  const choice = { name: label, what, place: onPlace };
  return (
    <Tooltip label={label} position="right">
      <ActionIcon
        size="lg"
        aria-label={t('place', { what: label })}
        data-testid={testId}
        disabled={!canPlace}
        {...(isPlaceless
          ? { onClick: onPlace }
          : {
              'aria-pressed': isChosen,
              variant: isChosen ? 'light' : 'subtle',
              color: isChosen ? 'indigo' : 'gray',
              onPointerDown: (event: PointerEvent<HTMLButtonElement>) =>
                dragFrom(event.currentTarget, event.nativeEvent, editor, choice),
              onClick: () => choose(editor, choice),
            })}
      >
        <Icon size={20} stroke={1.6} />
      </ActionIcon>
    </Tooltip>
  );
}

interface PlaceMenuProps {
  readonly editor: Editor;
  readonly icon: Icon;
  readonly label: string;
  readonly testId: string;
  readonly position: 'right-start' | 'right-end';
  readonly children: ReactNode;
}

/** One button for several things that can be placed. */
export function PlaceMenu({ editor, icon: Icon, label, testId, position, children }: PlaceMenuProps) {
  const isPlacing = useStore(editor.store, ({ placing }) => placing !== null);
  const canPlace = useStore(editor.store, (state) => state.canPlace);
  return (
    // The view needs the focus for the keys that place.
    <Menu position={position} returnFocus={!isPlacing}>
      <Tooltip label={label} position="right">
        <Menu.Target>
          <ActionIcon size="lg" aria-label={label} data-testid={testId} disabled={!canPlace}>
            <Icon size={20} stroke={1.6} />
          </ActionIcon>
        </Menu.Target>
      </Tooltip>
      <Menu.Dropdown>{children}</Menu.Dropdown>
    </Menu>
  );
}
