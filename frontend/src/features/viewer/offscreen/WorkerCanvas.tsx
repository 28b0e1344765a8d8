import { useEffect, useEffectEvent, useRef } from 'react';
import type { View } from './messages';
import { RemoteStage, type Reports } from './RemoteStage';
import classes from '../viewer.module.css';

interface WorkerCanvasProps extends Reports {
  readonly view: View;
  readonly label: string;
}

/** A canvas that fills the panel, on which a worker draws the world. */
export function WorkerCanvas({ view, label, ...reports }: WorkerCanvasProps) {
  const parent = useRef<HTMLDivElement>(null);
  const stage = useRef<RemoteStage | null>(null);
  const onTurned = useEffectEvent(reports.onTurned);
  const onSlow = useEffectEvent(reports.onSlow);
  const onDrawn = useEffectEvent(reports.onDrawn);
  const onFailed = useEffectEvent(reports.onFailed);
  const begin = useEffectEvent(
    (element: HTMLElement) => new RemoteStage(element, view, { onTurned, onSlow, onDrawn, onFailed }),
  );
  useEffect(() => {
    if (!parent.current) return;
    const made = begin(parent.current);
    stage.current = made;
    return () => {
      stage.current = null;
      made.end();
    };
  }, []);
  useEffect(() => stage.current?.show(view), [view]);
  return <div ref={parent} className={classes['canvas']} role="img" aria-label={label} />;
}
