import { useStoreApi } from '@xyflow/react';
import { useEffect, useMemo, useRef } from 'react';
import type { ChangeKind } from '@/model/difference/changes';
import type { NodeId } from '@/model/diagram';
import { onStatuses, shownStatus } from '@/store/moment/statusPainter';
import type { BlockNode, TreeEdge } from '../flow';
import { drawTiny, pathsOf } from './tinyTree';
import classes from '../Canvas.module.css';

interface Props {
  readonly nodes: readonly BlockNode[];
  readonly edges: readonly TreeEdge[];
  readonly marks: ReadonlyMap<NodeId, ChangeKind>;
}

/**
 * The whole tree in one picture, for a view from so far that blocks have a few pixels. It is drawn at most once
 * a frame, when statuses, view or theme changed. Hundreds of elements would be styled, laid out and painted
 * one by one, and show less.
 */
export function TinyPicture({ nodes, edges, marks }: Props) {
  const picture = useRef<HTMLCanvasElement>(null);
  const store = useStoreApi();
  const paths = useMemo(() => pathsOf({ nodes, edges }), [nodes, edges]);
  useEffect(() => {
    let request = 0;
    let colors = new Map<string, string>();
    const colorOf = (token: string): string => {
      const known = colors.get(token);
      if (known !== undefined || !picture.current) return known ?? '';
      const found = getComputedStyle(picture.current).getPropertyValue(`--bts-${token}`);
      colors.set(token, found);
      return found;
    };
    const draw = () => {
      request = 0;
      const element = picture.current;
      // Drawn by the processor: an emulated GPU takes seconds for what that does in a millisecond.
      const context = element?.getContext('2d', { willReadFrequently: true });
      if (!element || !context) return;
      const { transform, width, height } = store.getState();
      const ratio = window.devicePixelRatio || 1;
      const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
      if (element.width !== w || element.height !== h) [element.width, element.height] = [w, h];
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      context.clearRect(0, 0, width, height);
      drawTiny(context, { nodes, edges, marks, statusOf: shownStatus, colorOf }, paths, transform);
    };
    const drawSoon = () => {
      if (request === 0) request = requestAnimationFrame(draw);
    };
    const themed = new MutationObserver(() => {
      colors = new Map();
      drawSoon();
    });
    themed.observe(document.documentElement, { attributeFilter: ['data-mantine-color-scheme'] });
    const stops = [store.subscribe(drawSoon), onStatuses(drawSoon)];
    drawSoon();
    return () => {
      cancelAnimationFrame(request);
      themed.disconnect();
      stops.forEach((stop) => stop());
    };
  }, [nodes, edges, marks, paths, store]);
  return <canvas ref={picture} className={classes['tiny']} aria-hidden="true" data-testid="tiny-picture" />;
}
