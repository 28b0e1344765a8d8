import { ActionIcon, TextInput, Tooltip } from '@mantine/core';
import {
  IconArrowAutofitWidth,
  IconPlayerTrackNextFilled,
  IconSearch,
  IconZoomIn,
  IconZoomOut,
} from '@tabler/icons-react';
import { useVirtualizer } from '@tanstack/react-virtual';
import {
  useEffect,
  useMemo,
  useRef,
  useState,
  type KeyboardEvent,
  type MouseEvent,
  type PointerEvent,
} from 'react';
import { useTranslation } from 'react-i18next';
import { useProjectStore } from '@/store/project';
import { openTree } from '@/store/project/navigation';
import { goToChange, lookAt } from '@/store/moment/looking';
import { followShownTrace, shownTrace, useShownTrace } from '@/store/moment/shownTrace';
import { useSessionStore } from '@/store/session/store';
import { cancellable } from '@/ui/cancellable';
import { useVisible } from '@/ui/hooks/useVisible';
import { ROW_PX } from './draw';
import { Legend } from './Legend';
import { rowsOf, type TimelineRow } from './rows';
import { RowButton } from './RowButton';
import { Tip, type TipAt } from './Tip';
import classes from './timeline.module.css';
import { TimelineView } from './TimelineView';

const ZOOM_STEP = 1.4;
const PAN_STEP = 0.2;
const CLICK_PX = 4;

/** The panel with the statuses of each node over the last ten minutes of the run, one strip per node. */
export function TimelinePanel() {
  const { t } = useTranslation('timeline');
  const present = useSessionStore((state) => state.tree);
  const recorded = useShownTrace();
  const nodes = recorded.recorded ? recorded.nodes : present;
  const [search, setSearch] = useState('');
  const rows = useMemo(() => rowsOf(nodes, search), [nodes, search]);
  const uids = useMemo(() => rows.map((row) => row.uid), [rows]);
  const body = useRef<HTMLDivElement>(null);
  const scroller = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const isVisible = useVisible(body);
  const [view] = useState(() => new TimelineView());
  const [isFollowing, setFollowing] = useState(true);
  const [active, setActive] = useState(0);
  const [tip, setTip] = useState<TipAt | null>(null);
  const hasPanned = useRef(false);

  // The virtualizer has mutable state, so the compiler must not memoise this component.
  // eslint-disable-next-line react-hooks/incompatible-library
  const virtual = useVirtualizer({
    count: rows.length,
    getScrollElement: () => scroller.current,
    estimateSize: () => ROW_PX,
    getItemKey: (index) => rows[index]?.uid ?? index,
    overscan: 6,
    initialRect: { width: 600, height: 200 },
  });

  useEffect(() => {
    if (!isVisible || !canvas.current || !scroller.current) return;
    view.onFollowing = setFollowing;
    return view.attach(canvas.current, scroller.current);
  }, [view, isVisible]);
  useEffect(() => view.setRows(uids), [view, uids]);
  useEffect(() => (isVisible ? followShownTrace() : undefined), [isVisible]);
  useWheel(scroller, canvas, view);

  const shareOf = (clientX: number) => {
    const box = canvas.current?.getBoundingClientRect();
    return box && box.width > 0 ? (clientX - box.left) / box.width : -1;
  };

  /** Starts panning the range by a drag; Escape restores the range from before. */
  const onPress = ({ currentTarget, pointerId, clientX, button }: PointerEvent) => {
    hasPanned.current = false;
    if (button !== 0) return;
    const restore = view.remember();
    cancellable(currentTarget, pointerId, {
      onMove: (event) => {
        if (Math.abs(event.clientX - clientX) > CLICK_PX) hasPanned.current = true;
        if (hasPanned.current) view.pan(-event.movementX / Math.max(canvas.current?.clientWidth ?? 1, 1));
      },
      onCancel: restore,
    });
  };

  const showTip = (event: PointerEvent) => {
    const share = shareOf(event.clientX);
    const box = scroller.current?.getBoundingClientRect();
    if (share < 0 || !box) return setTip(null);
    const row = rows[Math.floor((event.clientY - box.top + (scroller.current?.scrollTop ?? 0)) / ROW_PX)];
    const { from, to } = view.span();
    setTip(row ? { x: event.clientX, y: event.clientY, row, time: from + share * (to - from) } : null);
  };

  /** Looks at the moment of a bar that is clicked. */
  const lookThere = ({ clientX, clientY, detail }: MouseEvent) => {
    const share = shareOf(clientX);
    const box = scroller.current?.getBoundingClientRect();
    // A click by a key has no place.
    if (detail === 0 || hasPanned.current || share < 0 || share > 1 || !box) return;
    const row = rows[Math.floor((clientY - box.top + (scroller.current?.scrollTop ?? 0)) / ROW_PX)];
    const { from, to } = view.span();
    const time = from + share * (to - from);
    const isBar =
      row &&
      shownTrace()
        .stretches(row.uid, time, time)
        .some(({ start, end }) => start <= time && end >= time);
    if (isBar) lookAt(time);
  };

  const select = (row: TimelineRow) => {
    if (hasPanned.current) return;
    if (!row.node) return;
    openTree(row.tree);
    useProjectStore.getState().reveal(row.tree, row.node);
  };

  const focusRow = (index: number) => {
    const next = Math.min(Math.max(index, 0), rows.length - 1);
    setActive(next);
    virtual.scrollToIndex(next);
    requestAnimationFrame(() =>
      scroller.current?.querySelector<HTMLElement>(`[data-index="${next}"]`)?.focus(),
    );
  };

  /** Goes to the next (1) or previous (-1) change of the row's node. */
  const toChange = (direction: 1 | -1) => {
    const row = rows[active];
    if (row) void goToChange(row.uid, direction);
  };

  const onKeyDown = (event: KeyboardEvent) => {
    const keys: Record<string, () => void> = {
      ArrowDown: () => focusRow(active + 1),
      ArrowUp: () => focusRow(active - 1),
      PageDown: () => focusRow(active + 10),
      PageUp: () => focusRow(active - 10),
      Home: () => focusRow(0),
      End: () => focusRow(rows.length - 1),
      ArrowLeft: () => view.pan(-PAN_STEP),
      ArrowRight: () => view.pan(PAN_STEP),
      '+': () => view.zoom(1 / ZOOM_STEP),
      '-': () => view.zoom(ZOOM_STEP),
      '0': () => view.showAll(),
      ',': () => toChange(-1),
      '.': () => toChange(1),
    };
    const doIt = keys[event.key];
    if (!doIt || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    doIt();
  };

  return (
    <section className={classes['panel']} data-testid="timeline" aria-label={t('label')}>
      <div className={classes['bar']}>
        <TextInput
          size="xs"
          type="search"
          className={classes['search']}
          value={search}
          placeholder={t('search')}
          aria-label={t('search')}
          leftSection={<IconSearch size={14} />}
          onChange={(event) => setSearch(event.currentTarget.value)}
        />
        <Legend />
        <span className={classes['spacer']} />
        <Tool label={t('zoomOut')} icon={IconZoomOut} onClick={() => view.zoom(ZOOM_STEP)} />
        <Tool label={t('zoomIn')} icon={IconZoomIn} onClick={() => view.zoom(1 / ZOOM_STEP)} />
        <Tool label={t('all')} icon={IconArrowAutofitWidth} onClick={() => view.showAll()} />
        <Tool
          label={t('follow')}
          icon={IconPlayerTrackNextFilled}
          isPressed={isFollowing}
          onClick={() => view.follow()}
        />
      </div>
      <div ref={body} className={classes['body']}>
        {rows.length === 0 ? (
          <p className={classes['empty']}>{t(nodes.length === 0 ? 'empty' : 'nothingMatches')}</p>
        ) : null}
        {/* The arrow keys move between the rows, whose buttons have the focus. */}
        {/* eslint-disable-next-line jsx-a11y/no-noninteractive-element-interactions */}
        <div
          ref={scroller}
          className={classes['scroller']}
          role="group"
          aria-label={t('rows')}
          onScroll={view.redraw}
          onClick={lookThere}
          onKeyDown={onKeyDown}
          onPointerDown={onPress}
          onPointerMove={showTip}
          onPointerLeave={() => setTip(null)}
        >
          <div className={classes['rows']} style={{ height: virtual.getTotalSize() }}>
            {virtual.getVirtualItems().map(({ index, start, key }) => {
              const row = rows[index];
              return row ? (
                <RowButton
                  key={key}
                  row={row}
                  index={index}
                  top={start}
                  isTabStop={index === Math.min(active, rows.length - 1)}
                  onSelect={select}
                  onFocus={setActive}
                />
              ) : null;
            })}
          </div>
        </div>
        <canvas ref={canvas} className={classes['canvas']} aria-hidden="true" />
        {tip ? <Tip {...tip} /> : null}
      </div>
    </section>
  );
}

interface ToolProps {
  readonly label: string;
  readonly icon: typeof IconZoomIn;
  readonly isPressed?: boolean;
  readonly onClick: () => void;
}

function Tool({ label, icon: Icon, isPressed, onClick }: ToolProps) {
  return (
    <Tooltip label={label}>
      <ActionIcon
        aria-label={label}
        {...(isPressed === undefined ? {} : { 'aria-pressed': isPressed })}
        {...(isPressed ? { variant: 'light', color: 'indigo' } : {})}
        onClick={onClick}
      >
        <Icon size={16} />
      </ActionIcon>
    </Tooltip>
  );
}

/**
 * Handles the wheel: it scrolls the rows, zooms at the pointer with Ctrl, and pans with Shift or sideways.
 */
function useWheel(
  scroller: { readonly current: HTMLDivElement | null },
  canvas: { readonly current: HTMLCanvasElement | null },
  view: TimelineView,
): void {
  useEffect(() => {
    const element = scroller.current;
    if (!element) return;
    const onWheel = (event: WheelEvent) => {
      const box = canvas.current?.getBoundingClientRect();
      if (!box || box.width === 0) return;
      const sideways = event.shiftKey ? event.deltaY || event.deltaX : event.deltaX;
      if (event.ctrlKey || event.metaKey) {
        event.preventDefault();
        view.zoom(
          Math.exp(event.deltaY * 0.002),
          Math.min(Math.max((event.clientX - box.left) / box.width, 0), 1),
        );
      } else if (sideways !== 0) {
        event.preventDefault();
        view.pan(sideways / box.width);
      }
    };
    element.addEventListener('wheel', onWheel, { passive: false });
    return () => element.removeEventListener('wheel', onWheel);
  }, [scroller, canvas, view]);
}
