import type { Place } from '../language/places';
import classes from './places.module.css';

interface PlaceTextProps {
  readonly place: Place;
  /** The name that replaces the marked text; undefined if nothing replaces it. */
  readonly after?: string;
}

/** A place: the number of its line, and the line with the place marked. */
export function PlaceText({ place: { line, from, to, text }, after }: PlaceTextProps) {
  const start = text.slice(0, from).trimStart();
  const name = text.slice(from, to);
  return (
    <>
      <span className={classes['number']}>{line + 1}</span>
      <span className={classes['code']}>
        {start}
        {after === undefined ? (
          <mark className={classes['hit']}>{name}</mark>
        ) : (
          <>
            <del className={classes['gone']}>{name}</del>
            <ins className={classes['new']}>{after}</ins>
          </>
        )}
        {text.slice(to)}
      </span>
    </>
  );
}
