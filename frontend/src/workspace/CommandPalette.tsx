import { Kbd } from '@mantine/core';
import { IconFileCode, IconGitFork, IconSearch } from '@tabler/icons-react';
import { useEffect, useLayoutEffect, useMemo, useRef, useState, type ComponentType } from 'react';
import { createPortal } from 'react-dom';
import { useTranslation } from 'react-i18next';
import { closePalette, usePalette } from '@/commands/palette';
import { perform, useCommandTable, type CommandGroup } from '@/commands/registry';
import { keysOf } from '@/commands/shortcuts';
import { matchScore } from '@/model/choices';
import { useProjectStore } from '@/store/project';
import classes from './commandPalette.module.css';
import type { DocumentTab } from './documents';
import { openTab, useTabs } from './tabs';

/** The groups of commands, the most frequently used first. */
const GROUPS: CommandGroup[] = ['run', 'project', 'canvas', 'edit', 'view', 'go', 'rates'];

interface Command {
  readonly id: string;
  readonly label: string;
  readonly icon: ComponentType<{ size?: number | string }> | undefined;
  readonly keys?: string | null;
  /**
   * Whether the command is available now. Unavailable commands are shown too, so that users can find them.
   */
  readonly isReady: boolean;
  readonly run: () => void;
}

/** Returns an entry for each command and each file. */
function useCommands(page: Document): Command[] {
  const { t } = useTranslation('frame');
  const table = useCommandTable((state) => state.commands);
  // The start page cannot open documents, although the store still has those of the last project.
  const hasDocuments = useTabs((state) => state.model !== null);
  const files = useProjectStore((state) => state.files);
  const diagrams = useProjectStore((state) => state.diagrams);
  // Computed once, before the palette takes the focus, since some commands depend on the focus; commands that
  // are added later count as available.
  const [unready] = useState(() => {
    const rows = Object.values(table).filter((command) => command.enabled?.() === false);
    return new Set(rows.map(({ id }) => id));
  });
  return useMemo(() => {
    const commands = Object.values(table)
      .filter((command) => !command.hidden)
      .sort((a, b) => GROUPS.indexOf(a.group) - GROUPS.indexOf(b.group))
      .map((command): Command => {
        const { id, labelKey, labelValues, icon } = command;
        const label = t(labelKey, { ...labelValues });
        return {
          id,
          label,
          icon,
          keys: keysOf(command),
          isReady: !unready.has(id),
          run: () => perform(id, page),
        };
      });
    const open = (id: string, label: string, icon: Command['icon'], tab: DocumentTab): Command => {
      return { id, label, icon, isReady: true, run: () => openTab(tab) };
    };
    const trees = Object.keys(diagrams).map((id) =>
      open(`tree:${id}`, t('palette.openTree', { name: id }), IconGitFork, { kind: 'tree', id }),
    );
    const texts = Object.values(files)
      .filter((file) => file.kind === 'text')
      .map(({ path }) =>
        open(`file:${path}`, t('palette.openFile', { name: path }), IconFileCode, { kind: 'file', path }),
      );
    return hasDocuments ? [...commands, ...trees, ...texts] : commands;
  }, [table, files, diagrams, hasDocuments, t, page, unready]);
}

/** Returns the matching commands, the best first; among equal matches, available commands come first. */
function matching(commands: readonly Command[], search: string): Command[] {
  const rated = commands.map((command) => ({ command, score: matchScore(command.label, search) }));
  return rated
    .filter(({ score }) => score > 0)
    .sort((a, b) => b.score - a.score || Number(b.command.isReady) - Number(a.command.isReady))
    .map(({ command }) => command);
}

/** A searchable list of all commands and files, in the window where the user opened it. */
export function CommandPalette() {
  const page = usePalette((state) => state.page);
  return page && createPortal(<Palette page={page} />, page.body);
}

function Palette({ page }: { readonly page: Document }) {
  const { t } = useTranslation('frame');
  const [search, setSearch] = useState('');
  const [index, setIndex] = useState(0);
  const list = useRef<HTMLDivElement>(null);
  const field = useRef<HTMLInputElement>(null);
  const commands = useCommands(page);
  const found = useMemo(() => matching(commands, search.trim()), [commands, search]);
  const active = Math.min(index, found.length - 1);

  useLayoutEffect(() => {
    const before = page.activeElement as HTMLElement | null;
    field.current?.focus();
    return () => {
      before?.focus({ preventScroll: true });
    };
  }, [page]);
  useEffect(() => {
    list.current?.querySelector('[aria-selected="true"]')?.scrollIntoView({ block: 'nearest' });
  }, [active, found]);

  const choose = (at: number): void => {
    if (!found[at]?.isReady) return;
    closePalette();
    // The command runs after the palette has returned the focus, since it may move the focus itself.
    setTimeout(() => found[at]?.run());
  };
  const moves: Record<string, () => void> = {
    Escape: closePalette,
    Enter: () => {
      choose(active);
    },
    ArrowDown: () => {
      setIndex((active + 1) % Math.max(1, found.length));
    },
    ArrowUp: () => {
      setIndex((active + found.length - 1) % Math.max(1, found.length));
    },
    Tab: () => undefined,
  };

  return (
    // A press outside of the palette closes it, like Escape.
    <div
      className={classes['backdrop']}
      onPointerDown={(event) => {
        if (event.target === event.currentTarget) closePalette();
      }}
    >
      <div
        className={classes['palette']}
        role="dialog"
        aria-modal="true"
        aria-label={t('palette.placeholder')}
        data-testid="command-palette"
      >
        <div className={classes['search']}>
          <IconSearch size={18} aria-hidden="true" />
          <input
            ref={field}
            role="combobox"
            // Escape closes the palette alone, not a dialogue below it, which listens at the window.
            data-mantine-stop-propagation="true"
            aria-expanded="true"
            aria-controls="commands"
            aria-activedescendant={found.length > 0 ? `command-${active}` : undefined}
            aria-label={t('palette.placeholder')}
            placeholder={t('palette.placeholder')}
            value={search}
            onChange={(event) => {
              setSearch(event.currentTarget.value);
              setIndex(0);
            }}
            onKeyDown={(event) => {
              const move = moves[event.key];
              if (!move) return;
              event.preventDefault();
              event.stopPropagation();
              move();
            }}
            onBlur={(event) => {
              if (page.hasFocus() && event.relatedTarget === null) event.currentTarget.focus();
            }}
          />
        </div>
        <div
          ref={list}
          id="commands"
          className={classes['list']}
          role="listbox"
          aria-label={t('palette.list')}
        >
          {found.map(({ id, label, icon: Icon, keys, isReady }, at) => (
            // The field keeps the keyboard focus: rows are chosen with the pointer, or with Enter.
            // eslint-disable-next-line jsx-a11y/click-events-have-key-events
            <div
              key={id}
              id={`command-${at}`}
              className={classes['row']}
              role="option"
              tabIndex={-1}
              aria-selected={at === active}
              aria-disabled={!isReady || undefined}
              onMouseDown={(event) => {
                event.preventDefault();
              }}
              onClick={() => {
                choose(at);
              }}
            >
              {Icon ? <Icon size={18} /> : null}
              <span className={classes['label']}>{label}</span>
              {keys ? <Kbd size="xs">{keys}</Kbd> : null}
            </div>
          ))}
        </div>
        {found.length === 0 && <p className={classes['nothing']}>{t('palette.nothing')}</p>}
      </div>
    </div>
  );
}
