import { useReactFlow, useStoreApi } from '@xyflow/react';
import { useComputedColorScheme } from '@mantine/core';
import { useEffect, useLayoutEffect, useMemo, useRef, type PointerEvent } from 'react';
import { useTranslation } from 'react-i18next';
import type { Box } from '@/model/layout';
import { cancellable } from '@/ui/cancellable';
import type { BlockNode, TreeEdge } from '../flow';
import { boundsOf, frameOf, shrink, type Shrinking } from './overview';
import classes from '../Canvas.module.css';

const PICTURE = { width: 168, height: 112 } as const;
const DRAW_WITHIN_MS = 200;

interface OverviewProps {
  readonly nodes: readonly BlockNode[];
  readonly edges: readonly TreeEdge[];
}

const boxOf = ({ position, width = 0, height = 0 }: BlockNode): Box => ({ ...position, width, height });

/** Draws the tree as one picture. It is drawn again when the tree changes, but not when the view moves. */
function draw(picture: HTMLCanvasElement, { nodes, edges }: OverviewProps, { sx, sy, left, top }: Shrinking) {
  const ratio = window.devicePixelRatio || 1;
  picture.width = PICTURE.width * ratio;
  picture.height = PICTURE.height * ratio;
  const context = picture.getContext('2d');
  if (!context) return;
  context.scale(ratio, ratio);
  const tokens = getComputedStyle(picture);
  const token = (name: string): string => tokens.getPropertyValue(`--bts-${name}`);
  const places = new Map(nodes.map((node) => [node.id, boxOf(node)]));
  context.strokeStyle = token('edge');
  context.globalAlpha = 0.5;
  context.lineWidth = 0.75;
  context.beginPath();
  for (const { source, target } of edges) {
    const [from, to] = [places.get(source), places.get(target)];
    if (!from || !to) continue;
    context.moveTo(left + (from.x + from.width / 2) * sx, top + (from.y + from.height / 2) * sy);
    context.lineTo(left + (to.x + to.width / 2) * sx, top + (to.y + to.height / 2) * sy);
  }
  context.stroke();
  context.globalAlpha = 1;
  const colors = new Map<string, string>();
  const paint = ({ position, width = 0, height = 0 }: BlockNode, color: string): void => {
    context.fillStyle = color;
    const [w, h] = [Math.max(1, width * sx), Math.max(2, height * sy)];
    context.fillRect(left + position.x * sx, top + position.y * sy, w, h);
  };
  for (const node of nodes) {
    const family = node.data.spec?.family ?? 'unknown';
    const color = colors.get(family) ?? token(family);
    colors.set(family, color);
    paint(node, node.data.node.color ?? color);
  }
  for (const node of nodes) if (node.data.problem?.severity === 'error') paint(node, token('failure-bright'));
}

/**
 * A small picture of the whole tree with the visible part marked. A press or a drag moves the view; Escape
 * moves it back.
 */
export function Overview({ nodes, edges }: OverviewProps) {
  const { t } = useTranslation('canvas');
  const picture = useRef<HTMLCanvasElement>(null);
  const frame = useRef<HTMLDivElement>(null);
  const store = useStoreApi();
  const flow = useReactFlow();
  const scheme = useComputedColorScheme();
  const shrinking = useMemo(() => shrink(boundsOf(nodes.map(boxOf)), PICTURE), [nodes]);

  useEffect(() => {
    const paint = () => {
      if (picture.current) draw(picture.current, { nodes, edges }, shrinking);
    };
    if (!('requestIdleCallback' in window)) return paint();
    const request = requestIdleCallback(paint, { timeout: DRAW_WITHIN_MS });
    return () => {
      cancelIdleCallback(request);
    };
  }, [nodes, edges, shrinking, scheme]);

  useLayoutEffect(() => {
    const follow = () => {
      const { transform, width, height } = store.getState();
      const style = frame.current?.style;
      if (!style) return;
      const [x, y, zoom] = transform;
      const view = { x: -x / zoom, y: -y / zoom, width: width / zoom, height: height / zoom };
      const box = frameOf(view, shrinking, PICTURE);
      style.transform = `translate(${box.x}px, ${box.y}px)`;
      style.width = `${box.width}px`;
      style.height = `${box.height}px`;
    };
    follow();
    return store.subscribe(follow);
  }, [store, shrinking]);

  const begin = ({
    currentTarget,
    pointerId,
    clientX,
    clientY,
    button,
  }: PointerEvent<HTMLDivElement>): void => {
    if (button !== 0) return;
    const before = flow.getViewport();
    const { left, top } = currentTarget.getBoundingClientRect();
    const goTo = (point: { readonly clientX: number; readonly clientY: number }): void => {
      const x = (point.clientX - left - shrinking.left) / shrinking.sx;
      const y = (point.clientY - top - shrinking.top) / shrinking.sy;
      void flow.setCenter(x, y, { zoom: flow.getZoom() });
    };
    goTo({ clientX, clientY });
    cancellable(currentTarget, pointerId, { onMove: goTo, onCancel: () => void flow.setViewport(before) });
  };

  return (
    <div
      className={`${classes['minimap']} nowheel nopan`}
      role="img"
      aria-label={t('minimap')}
      data-testid="minimap"
      data-overlay
      onPointerDown={begin}
    >
      <canvas ref={picture} />
      <div ref={frame} className={classes['view']} />
    </div>
  );
}
