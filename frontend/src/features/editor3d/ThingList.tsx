import { ActionIcon, TextInput, Tooltip } from '@mantine/core';
import { IconCopyPlus, IconTrash, type IconBox } from '@tabler/icons-react';
import { useEffect, useRef, useState, type KeyboardEvent, type MouseEvent, type ReactNode } from 'react';
import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import { useUnsaved } from '@/store/saving/useUnsaved';
import classes from './editor3d.module.css';
import { isReadOnly, select, toggle, type Editor } from './editing';

/** One row of the list of things. */
export interface Listed {
  readonly key: string;
  readonly name: string;
  readonly icon: typeof IconBox;
  readonly color?: string;
}

interface ThingListProps {
  readonly editor: Editor;
  readonly title: string;
  readonly things: readonly Listed[];
  /** The label and icon of the document as a whole, which has no row in the list. */
  readonly whole: { readonly label: string; readonly icon: typeof IconBox };
  readonly onDuplicate: () => void;
  readonly onDelete: () => void;
  /**
   * Returns the reason why a name is invalid; null if it is valid. Without this function, the list cannot
   * rename things.
   */
  readonly nameProblem?: (key: string, name: string) => string | null;
  readonly onRename?: (key: string, name: string) => void;
}

/** The list of all things by name, in the order of the document. */
export function ThingList(props: ThingListProps) {
  const { editor, title, things, whole, onDuplicate, onDelete, nameProblem, onRename } = props;
  const { t } = useTranslation('editor3d');
  const selection = useStore(editor.store, (state) => state.selection);
  const [renaming, setRenaming] = useState<string | null>(null);
  const list = useRef<HTMLDivElement>(null);
  const last = selection.at(-1);

  useEffect(() => {
    const row = last === undefined ? null : list.current?.querySelector(`[data-key="${CSS.escape(last)}"]`);
    row?.scrollIntoView({ block: 'nearest' });
  }, [last]);

  const canRename = onRename !== undefined && !isReadOnly();
  const Whole = whole.icon;

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
    } else if (event.key === 'F2' && last !== undefined && canRename) setRenaming(last);
    else if (event.key === 'Delete') onDelete();
    else if (event.key.toLowerCase() === 'd' && (event.ctrlKey || event.metaKey)) onDuplicate();
    else return;
    event.preventDefault();
    event.stopPropagation();
  };

  return (
    <section className={classes['things']}>
      <header className={classes['thingsHead']}>
        <h2>{title}</h2>
        <ListButton
          label={whole.label}
          isDisabled={selection.length === 0}
          onClick={() => select(editor, [])}
        >
          <Whole size={16} />
        </ListButton>
        <ListButton
          label={`${t('duplicate')} (Ctrl+D)`}
          isDisabled={selection.length === 0 || isReadOnly()}
          onClick={() => onDuplicate()}
        >
          <IconCopyPlus size={16} />
        </ListButton>
        <ListButton
          label={`${t('delete')} (Del)`}
          isDisabled={selection.length === 0 || isReadOnly()}
          onClick={() => onDelete()}
        >
          <IconTrash size={16} />
        </ListButton>
      </header>
      <div
        ref={list}
        role="listbox"
        tabIndex={-1}
        aria-multiselectable="true"
        aria-label={title}
        onKeyDown={onKey}
      >
        {things.map((thing, index) => {
          const Icon = thing.icon;
          const isSelected = selection.includes(thing.key);
          return (
            // The list handles the keys for all of its rows.
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
                if (canRename) setRenaming(thing.key);
              }}
            >
              <Icon size={15} stroke={1.6} aria-hidden="true" />
              {renaming === thing.key ? (
                <Rename
                  thing={thing}
                  problemOf={(name) => nameProblem?.(thing.key, name) ?? null}
                  onName={(name) => onRename?.(thing.key, name)}
                  onEnd={() => setRenaming(null)}
                />
              ) : (
                <span className={classes['name']}>{thing.name}</span>
              )}
              {thing.color ? <span className={classes['dot']} style={{ background: thing.color }} /> : null}
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
  readonly children: ReactNode;
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

interface RenameProps {
  readonly thing: Listed;
  readonly problemOf: (name: string) => string | null;
  readonly onName: (name: string) => void;
  readonly onEnd: () => void;
}

function Rename({ thing, problemOf, onName, onEnd }: RenameProps) {
  const { t } = useTranslation('editor3d');
  const [name, setName] = useState(thing.name);
  useUnsaved(name !== thing.name);
  const problem = problemOf(name);
  const finish = () => {
    if (!problem) onName(name);
    onEnd();
  };
  return (
    <TextInput
      size="xs"
      className={classes['rename'] ?? ''}
      aria-label={t('id')}
      value={name}
      autoFocus // eslint-disable-line jsx-a11y/no-autofocus -- the user has just asked to type here
      error={problem}
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
