import { IconPlus } from '@tabler/icons-react';
import { useEffect, useLayoutEffect, useMemo, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { shippedChoice } from '@/i18n/shipped';
import { allChoices, matchScore, searchChoices, suits, type Purpose } from '@/model/choices';
import { childrenOf, type Diagram } from '@/model/diagram';
import { isPythonName } from '@/model/pythonNames';
import { createAction } from '@/store/project/edits/actionTemplate';
import { achieve } from '@/store/project/edits/blocks';
import { setEditor, type QuickAdd as QuickAddState } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import { useOfferedStore } from '@/store/project/offered';
import { kindsFor } from './actionKinds';
import { ChoiceRow } from './ChoiceRow';
import classes from './QuickAdd.module.css';

function purposeOf({ goal }: QuickAddState): Purpose {
  switch (goal.does) {
    case 'add':
      return { for: 'add' };
    case 'wrap':
      return { for: 'wrap', count: goal.nodes.length };
    case 'morph':
      return { for: 'morph', node: goal.node };
  }
}

/** Returns the number of children that the chosen block will have at once. */
function heldChildren({ goal }: QuickAddState, diagram: Diagram): number {
  switch (goal.does) {
    case 'add':
      return 0;
    case 'wrap':
      return goal.nodes.length;
    case 'morph':
      return childrenOf(diagram, goal.node).length;
  }
}

interface QuickAddProps {
  readonly request: QuickAddState;
  /** Called when the box closes; must return the focus to the canvas. */
  readonly onClose: () => void;
}

const WIDTH = 340;
const HEIGHT = 380;

/** A search box at the place of a new block, with the blocks that are allowed there. */
export function QuickAdd({ request, onClose }: QuickAddProps) {
  const { t } = useTranslation('canvas');
  const diagram = useProjectStore((state) => state.diagrams[request.tree]);
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const offered = useOfferedStore((state) => state.specs);
  const [search, setSearch] = useState(request.text);
  /** The chosen row. It is null until the user moves the choice; then the most likely row counts. */
  const [index, setIndex] = useState<number | null>(null);
  const list = useRef<HTMLDivElement>(null);
  const field = useRef<HTMLInputElement>(null);

  useLayoutEffect(() => {
    field.current?.focus({ preventScroll: true });
  }, []);

  const found = useMemo(() => {
    if (!diagram) return [];
    const purpose = purposeOf(request);
    return searchChoices(
      allChoices(diagram, vocabulary, offered).filter((choice) => suits(choice, diagram, purpose)),
      search,
      shippedChoice,
    );
  }, [diagram, vocabulary, offered, request, search]);
  const canCreate = diagram !== undefined && isPythonName(search) && !vocabulary.specs.has(search);
  const made = canCreate ? kindsFor(search, heldChildren(request, diagram)) : [];
  const count = found.length + made.length;
  // If no block has this name, it means a new action, even if a description contains the word.
  const least = /^[A-Z]/.test(search) ? 3 : 1;
  const isNamed = found.some(({ label }) => matchScore(label, search) >= least);
  const likely = made.length > 0 && !isNamed ? found.length : 0;
  const active = Math.min(index ?? likely, count - 1);

  useEffect(() => {
    list.current?.querySelector('[aria-selected="true"]')?.scrollIntoView({ block: 'nearest' });
  }, [active]);

  const close = (): void => {
    setEditor({ quickAdd: null });
    onClose();
  };
  const choose = (at: number): void => {
    const choice = found[at];
    if (choice) achieve(request.goal, choice.kind);
    else {
      const kind = made[at - found.length];
      if (kind === undefined) return;
      createAction(search, kind);
      achieve(request.goal, { type: search });
    }
    close();
  };

  const left = Math.max(8, Math.min(request.x, window.innerWidth - WIDTH - 8));
  const top = Math.max(8, Math.min(request.y, window.innerHeight - HEIGHT - 8));
  return (
    // The handler only observes the focus, which is no interaction.
    // eslint-disable-next-line jsx-a11y/no-noninteractive-element-interactions
    <div
      className={classes['box']}
      style={{ left, top, width: WIDTH, maxHeight: HEIGHT }}
      role="dialog"
      aria-label={t(`quickAdd.${request.goal.does}`)}
      data-testid="quick-add"
      onBlur={(event) => {
        if (!event.currentTarget.contains(event.relatedTarget)) setEditor({ quickAdd: null });
      }}
    >
      <input
        className={classes['input']}
        ref={field}
        role="combobox"
        aria-expanded="true"
        aria-controls="quick-add-list"
        aria-activedescendant={count > 0 ? `quick-add-${active}` : undefined}
        aria-label={t(`quickAdd.${request.goal.does}`)}
        placeholder={t(`quickAdd.${request.goal.does}`)}
        value={search}
        onChange={(event) => {
          setSearch(event.currentTarget.value);
          setIndex(null);
        }}
        onKeyDown={(event) => {
          event.stopPropagation();
          if (event.key === 'Escape') close();
          else if (event.key === 'Enter' || event.key === 'Tab') {
            event.preventDefault();
            choose(active);
          } else if (event.key === 'ArrowDown') {
            event.preventDefault();
            setIndex((active + 1) % Math.max(1, count));
          } else if (event.key === 'ArrowUp') {
            event.preventDefault();
            setIndex((active + count - 1) % Math.max(1, count));
          }
        }}
      />
      <div
        className={classes['list']}
        id="quick-add-list"
        role="listbox"
        ref={list}
        aria-label={t('quickAdd.list')}
      >
        {found.map((choice, at) => (
          <ChoiceRow
            key={`${choice.kind.type}/${choice.kind.tree ?? ''}`}
            id={`quick-add-${at}`}
            choice={choice}
            isActive={at === active}
            onChoose={() => {
              choose(at);
            }}
          />
        ))}
        {made.map((kind, at) => (
          <div
            key={kind}
            id={`quick-add-${found.length + at}`}
            role="option"
            tabIndex={-1}
            aria-selected={active === found.length + at}
            className={classes['row']}
          >
            <button
              type="button"
              tabIndex={-1}
              className={classes['choice']}
              data-testid={`quick-add-new-${kind}`}
              onPointerDown={(event) => {
                event.preventDefault();
                choose(found.length + at);
              }}
            >
              <span className={classes['create']}>
                <IconPlus size={16} aria-hidden="true" />
              </span>
              <span className={classes['label']}>{t(`quickAdd.create${kind}`, { name: search })}</span>
            </button>
          </div>
        ))}
        {count === 0 && <div className={classes['nothing']}>{t('quickAdd.nothing')}</div>}
      </div>
      <div className={classes['keys']} aria-hidden="true">
        {t('quickAdd.keys')}
      </div>
    </div>
  );
}
