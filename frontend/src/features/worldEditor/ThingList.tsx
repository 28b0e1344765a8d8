import { ActionIcon, TextInput, Tooltip } from '@mantine/core';
import {
  IconBox,
  IconCopyPlus,
  IconCube,
  IconCylinder,
  IconPuzzle,
  IconRobot,
  IconSphere,
  IconSquare,
  IconTrash,
  IconUser,
  IconWorld,
} from '@tabler/icons-react';
import { useEffect, useRef, useState, type KeyboardEvent, type MouseEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import { idProblem, rename } from '@/model/universe/edits';
import type { Thing, Universe } from '@/model/universe/types';
import { deleteSelected, duplicateSelected } from './commands';
import { edit, isReadOnly, select, toggle, type UniverseEditor } from './editor';
import classes from './worldEditor.module.css';

interface ThingListProps {
  readonly editor: UniverseEditor;
  readonly universe: Universe;
}

const SHAPE_ICONS = {
  box: IconCube,
  cylinder: IconCylinder,
  sphere: IconSphere,
  plane: IconSquare,
  mesh: IconPuzzle,
  urdf: IconBox,
  sdf: IconBox,
};

function iconOf(thing: Thing): typeof IconBox {
  if (thing.section === 'actors') return IconUser;
  return thing.section === 'robots' ? IconRobot : SHAPE_ICONS[thing.shape];
}

/** Every thing by name, in the order of the document. */
export function ThingList({ editor, universe }: ThingListProps) {
  const { t } = useTranslation('worldEditor');
  const selection = useStore(editor.store, (state) => state.selection);
  const [renaming, setRenaming] = useState<string | null>(null);
  const list = useRef<HTMLDivElement>(null);
  const { things } = universe;
  const last = selection.at(-1);

  useEffect(() => {
    const row = last === undefined ? null : list.current?.querySelector(`[data-key="${CSS.escape(last)}"]`);
    row?.scrollIntoView({ block: 'nearest' });
  }, [last]);

  const choose = (key: string, event: MouseEvent | KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey) return toggle(editor, key);
    if (!event.shiftKey || last === undefined) return select(editor, [key]);
    const order = things.map((thing) => thing.key);
    const [from = 0, to = 0] = [order.indexOf(last), order.indexOf(key)].sort((a, b) => a - b);
    select(editor, order.slice(from, to + 1));
  };

  const onKey = (event: KeyboardEvent) => {
    if (event.target instanceof HTMLInputElement) return;
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    const at = things.findIndex(({ key }) => key === last);
    if (step !== undefined) {
      const next = things[Math.min(Math.max(at + step, 0), things.length - 1)];
      if (next) select(editor, [next.key]);
      requestAnimationFrame(() =>
        list.current?.querySelector<HTMLElement>('[aria-selected="true"]')?.focus(),
      );
    } else if (event.key === 'F2' && last !== undefined && !isReadOnly()) setRenaming(last);
    else if (event.key === 'Delete') deleteSelected(editor);
    else if (event.key.toLowerCase() === 'd' && (event.ctrlKey || event.metaKey)) duplicateSelected(editor);
    else return;
    event.preventDefault();
    event.stopPropagation();
  };

  return (
    <section className={classes['things']}>
      <header className={classes['thingsHead']}>
        <h3>{t('things', { count: things.length })}</h3>
        <ListButton label={t('world')} isDisabled={selection.length === 0} onClick={() => select(editor, [])}>
          <IconWorld size={16} />
        </ListButton>
        <ListButton
          label={`${t('duplicate')} (Ctrl+D)`}
          isDisabled={selection.length === 0 || isReadOnly()}
          onClick={() => duplicateSelected(editor)}
        >
          <IconCopyPlus size={16} />
        </ListButton>
        <ListButton
          label={`${t('delete')} (Del)`}
          isDisabled={selection.length === 0 || isReadOnly()}
          onClick={() => deleteSelected(editor)}
        >
          <IconTrash size={16} />
        </ListButton>
      </header>
      <div
        ref={list}
        role="listbox"
        tabIndex={-1}
        aria-multiselectable="true"
        aria-label={t('things', { count: things.length })}
        onKeyDown={onKey}
      >
        {things.map((thing, index) => {
          const Icon = iconOf(thing);
          const isSelected = selection.includes(thing.key);
          return (
            // The list hears the keys for all of its rows.
            // eslint-disable-next-line jsx-a11y/click-events-have-key-events
            <div
              key={thing.key}
              role="option"
              aria-selected={isSelected}
              tabIndex={isSelected || (selection.length === 0 && index === 0) ? 0 : -1}
              data-key={thing.key}
              data-testid={`thing-${thing.key}`}
              onClick={(event) => choose(thing.key, event)}
              onDoubleClick={() => {
                if (!isReadOnly()) setRenaming(thing.key);
              }}
            >
              <Icon size={15} stroke={1.6} aria-hidden="true" />
              {renaming === thing.key ? (
                <Rename editor={editor} universe={universe} thing={thing} onEnd={() => setRenaming(null)} />
              ) : (
                <span className={classes['name']}>{thing.id || t('nameless')}</span>
              )}
              {'color' in thing ? (
                <span className={classes['dot']} style={{ background: thing.color }} />
              ) : null}
            </div>
          );
        })}
      </div>
    </section>
  );
}

interface ListButtonProps {
  readonly label: string;
  readonly isDisabled: boolean;
  readonly onClick: () => void;
  readonly children: React.ReactNode;
}

function ListButton({ label, isDisabled, onClick, children }: ListButtonProps) {
  return (
    <Tooltip label={label}>
      <ActionIcon size="sm" aria-label={label} disabled={isDisabled} onClick={onClick}>
        {children}
      </ActionIcon>
    </Tooltip>
  );
}

interface RenameProps extends ThingListProps {
  readonly thing: Thing;
  readonly onEnd: () => void;
}

function Rename({ editor, universe, thing, onEnd }: RenameProps) {
  const { t } = useTranslation('worldEditor');
  const [name, setName] = useState(thing.id);
  const problem = idProblem(universe, thing.key, name);
  const finish = () => {
    if (!problem) edit(editor, 'rename', (now) => rename(now, thing.key, name));
    onEnd();
  };
  return (
    <TextInput
      size="xs"
      className={classes['rename'] ?? ''}
      aria-label={t('id')}
      value={name}
      autoFocus // eslint-disable-line jsx-a11y/no-autofocus -- the user has just asked to type here
      error={problem ? t(`problem.${problem}`, { id: name, most: 80 }) : null}
      onChange={(event) => setName(event.currentTarget.value)}
      onFocus={(event) => event.currentTarget.select()}
      onBlur={finish}
      onKeyDown={(event) => {
        event.stopPropagation();
        if (event.key === 'Enter') finish();
        if (event.key === 'Escape') onEnd();
      }}
    />
  );
}
