import { useVirtualizer, type Virtualizer } from '@tanstack/react-virtual';
import { useCallback, useEffect, useMemo, useRef, useState, type PointerEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { useShallow } from 'zustand/react/shallow';
import { useProjectStore } from '@/store/project';
import { useExtent } from '@/store/moment/useExtent';
import { usePastSession, useShownSession } from '@/store/moment/session';
import { useIsBack, useMoment } from '@/store/moment/store';
import { useSettled } from '@/store/moment/useSettled';
import { useSessionStore } from '@/store/session/store';
import type { LogLine } from '@/store/session/types';
import classes from './console.module.css';
import { ConsoleBar } from './ConsoleBar';
import { ConsoleLine } from './ConsoleLine';
import { filterLines, useConsoleFilter } from './filter';

const LINE_HEIGHT = 21;
/** A line with a button is as high as a target must be. */
const TARGET_HEIGHT = 24;
const SOURCES = ['all', 'action', 'world', 'manager', 'launch'] as const;

const LINE_STORES = [useMoment, usePastSession, useSessionStore];
const shownLines = () =>
  (useMoment.getState().shown === null ? useSessionStore : usePastSession).getState().logs;

/** The output of actions, world and manager. The view follows the end until the user scrolls up. */
export function ConsolePanel() {
  const { t } = useTranslation('console');
  const logs = useSettled(shownLines, LINE_STORES);
  const isBack = useIsBack();
  const filePaths = useProjectStore(useShallow((state) => Object.keys(state.files)));
  const files = useMemo(() => new Set(filePaths), [filePaths]);
  const nodes = useShownSession(({ tree }) => tree);
  const nodeAt = useMemo(() => new Map(nodes.map((node) => [node.path, node])), [nodes]);
  const filter = useConsoleFilter();
  const launched = useSessionStore((state) => state.launchNodes);
  const names = useMemo(() => new Map(launched.map(({ id, name }) => [id, name])), [launched]);
  const sources = useSources(names, filter.source);
  const lines = useMemo(() => filterLines(logs, filter), [logs, filter]);
  const recordedFrom = useExtent()?.from ?? Infinity;
  const runFrom = useMemo(() => logs.findLast(({ run }) => run !== undefined)?.id ?? -1, [logs]);
  const isRecorded = ({ id, time }: LogLine) => id > runFrom && time >= recordedFrom;
  const heightAt = (index: number) => {
    const line = lines[index];
    const hasButton = line && (isRecorded(line) || nodeAt.get(line.node_path)?.node_id);
    return hasButton ? TARGET_HEIGHT : LINE_HEIGHT;
  };
  const [isFollowing, setFollowing] = useState(true);
  const toEnd = useCallback(() => setFollowing(true), []);
  const scroller = useRef<HTMLDivElement>(null);
  // The virtualizer has mutable state, so the compiler must not memoise this component.
  // eslint-disable-next-line react-hooks/incompatible-library
  const rows = useVirtualizer({
    count: lines.length,
    getScrollElement: () => scroller.current,
    estimateSize: heightAt,
    getItemKey: (index) => lines[index]?.id ?? index,
    measureElement: heightOf,
    // A jump on the time axis replaces the lines before the end; nobody scrolls them meanwhile.
    overscan: isBack && isFollowing ? 2 : 12,
    initialRect: { width: 600, height: 200 },
  });

  const size = rows.getTotalSize();
  const top = useRef(0);
  const { isHeld, isScrolling, onHand } = useHand();
  useEffect(() => {
    const element = scroller.current;
    if (isFollowing && !isHeld && element) element.scrollTop = element.scrollHeight;
  }, [lines, size, isFollowing, isHeld]);

  const onScroll = () => {
    const element = scroller.current;
    if (!element) return;
    const { scrollTop, scrollHeight, clientHeight } = element;
    const isAtEnd = scrollHeight - scrollTop - clientHeight < LINE_HEIGHT * 2;
    // Only when the user scrolls up does the view stop following the end: filtering, measuring and showing a
    // hidden panel also scroll.
    if (isAtEnd || (scrollTop < top.current && isScrolling())) setFollowing(isAtEnd);
    top.current = scrollTop;
  };

  return (
    <div className={classes['panel']} data-testid="console">
      <ConsoleBar
        sources={sources}
        toEnd={isFollowing ? null : toEnd}
        mayClear={logs.length > 0 && !isBack}
      />
      <div
        ref={scroller}
        className={classes['scroller']}
        onScroll={onScroll}
        {...onHand}
        role="log"
        aria-label={t('label')}
        // A scrollable region must be reachable by keyboard.
        // eslint-disable-next-line jsx-a11y/no-noninteractive-tabindex
        tabIndex={0}
      >
        {lines.length === 0 ? (
          <p className={classes['empty']}>{t(logs.length === 0 ? 'empty' : 'nothingMatches')}</p>
        ) : (
          <div className={classes['lines']} style={{ height: size }}>
            {rows.getVirtualItems().map((row) => {
              const line = lines[row.index];
              return line ? (
                <div
                  key={row.key}
                  ref={rows.measureElement}
                  data-index={row.index}
                  className={classes['row']}
                  style={{ transform: `translateY(${row.start}px)` }}
                >
                  <ConsoleLine
                    line={line}
                    files={files}
                    node={nodeAt.get(line.node_path)}
                    launched={names.get(line.launch_node)}
                    isRecorded={isRecorded(line)}
                    t={t}
                  />
                </div>
              ) : null;
            })}
          </div>
        )}
      </div>
    </div>
  );
}

/**
 * Returns the height of a row: as the browser reports it, or as it is expected until then. To ask for it at once
 * would make the browser lay out the whole page for each new row.
 */
function heightOf(
  row: HTMLDivElement,
  entry: ResizeObserverEntry | undefined,
  { indexFromElement, options, itemSizeCache }: Virtualizer<HTMLDivElement, HTMLDivElement>,
): number {
  const [box] = entry?.borderBoxSize ?? [];
  if (box) return Math.round(box.blockSize);
  const index = indexFromElement(row);
  return itemSizeCache.get(options.getItemKey(index)) ?? options.estimateSize(index);
}

/** The time in ms after a wheel or key event in which scrolling counts as the user's. */
const HAND_MS = 1000;

/** Tracks the user's pointer and keys on the lines. */
function useHand() {
  const [isHeld, setHeld] = useState(false);
  const isDragged = useRef(false);
  const lastMove = useRef(-Infinity);
  const move = () => {
    lastMove.current = performance.now();
  };
  const hold = ({ target, currentTarget }: PointerEvent) => {
    // The click follows this event, and must hit the pressed element.
    const release = () => setTimeout(() => setHeld(false));
    setHeld(true);
    // The scroller itself is pressed at its scroll bar. A line that is pressed and not dragged scrolls nothing:
    // what scrolls meanwhile is a search that ended, or a panel that became lower.
    isDragged.current = target === currentTarget;
    for (const end of ['pointerup', 'pointercancel'])
      currentTarget.ownerDocument.addEventListener(end, release, { once: true });
  };
  const drag = () => {
    isDragged.current = true;
  };
  return {
    /** Whether a finger or a mouse button is down: then the lines must not move. */
    isHeld,
    /** Returns whether the user is scrolling. */
    isScrolling: () => (isHeld && isDragged.current) || performance.now() - lastMove.current < HAND_MS,
    onHand: { onPointerDown: hold, onPointerMove: drag, onWheel: move, onTouchMove: move, onKeyDown: move },
  };
}

/**
 * Returns the sources to choose from, including each launch node of the run; the chosen source stays in the
 * list even if it has ended.
 */
function useSources(names: ReadonlyMap<string, string>, chosen: string): { value: string; label: string }[] {
  const { t } = useTranslation('console');
  return useMemo(() => {
    const nodes = [...names].map(([id, name]) => ({
      value: `launch:${id}`,
      label: t('sourceNode', { name }),
    }));
    const isGone = chosen.startsWith('launch:') && !nodes.some(({ value }) => value === chosen);
    const gone = { value: chosen, label: chosen.slice('launch:'.length) };
    const sources = SOURCES.map((value) => ({ value: value as string, label: t(`sources.${value}`) }));
    return [...sources, ...nodes, ...(isGone ? [gone] : [])];
  }, [t, names, chosen]);
}
