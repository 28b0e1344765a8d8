import { useStoreApi } from '@xyflow/react';
import { useLayoutEffect, useRef } from 'react';
import classes from '../Canvas.module.css';

const GAP = 24;
/**
 * The smallest distance of dots in px. Denser dots would blur to grey, so when zoomed out, only every second,
 * fourth … dot is drawn.
 */
const CLOSEST = 12;

/** The dots behind the tree. They follow the view outside of React, which would render them at each frame. */
export function Dots() {
  const dots = useRef<HTMLDivElement>(null);
  const store = useStoreApi();
  useLayoutEffect(() => {
    let zoom = 0;
    let gap = GAP;
    const follow = () => {
      const { transform } = store.getState();
      const style = dots.current?.style;
      if (!style) return;
      if (transform[2] !== zoom) {
        zoom = transform[2];
        gap = GAP * zoom;
        while (gap < CLOSEST) gap *= 2;
        style.backgroundSize = `${gap}px ${gap}px`;
        style.setProperty('--dot', `${Math.max(0.5, 0.8 * zoom)}px`);
      }
      style.backgroundPosition = `${transform[0] - gap / 2}px ${transform[1] - gap / 2}px`;
    };
    follow();
    return store.subscribe(follow);
  }, [store]);
  return <div ref={dots} className={classes['dots']} />;
}
