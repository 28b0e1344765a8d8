import { create } from 'zustand';

/** What drives the paths: the comparison of two runs, or values that were tried. */
export type PathOwner = 'compare' | 'tries';

/** A course of the robots that is drawn in 3D. */
export interface ShownPath {
  /** A few characters at the path's end, which the legend has, too: a colour alone would not do. */
  readonly label: string;
  readonly name: string;
  /** In degrees; null: the colour of text. */
  readonly hue: number | null;
  readonly isDashed: boolean;
  /** Where its label is: at the shown moment, or at its end. */
  readonly labelAt: 'moment' | 'end';
  /** For each robot its points: x and y in m, the time in s, and 1 where a path begins. */
  readonly lines: readonly Float32Array[];
}

interface ShownPaths {
  readonly owner: PathOwner | null;
  readonly paths: readonly ShownPath[];
}

const nothing: ShownPaths = { owner: null, paths: [] };

/** The paths that the 3D views draw beside the trail. */
export const useShownPaths = create<ShownPaths>(() => nothing);

/** Draws paths, in place of all others. */
export const showPaths = (owner: PathOwner, paths: readonly ShownPath[]): void =>
  useShownPaths.setState({ owner, paths });

/** Draws the paths of an owner no more; those of another one stay. */
export function hidePaths(owner: PathOwner): void {
  if (useShownPaths.getState().owner === owner) useShownPaths.setState(nothing);
}

/** The angle between the hues of paths that follow each other: neighbours differ, and none comes twice. */
const GOLDEN_DEGREES = 137.5;
const FIRST_DEGREES = 215;

/** Returns the hue of the n-th path, in degrees; the path with the number 0 has none of its own. */
export const hueOf = (index: number): number | null =>
  index === 0 ? null : Math.round(((index - 1) * GOLDEN_DEGREES + FIRST_DEGREES) % 360);

/** Returns a hue as a colour of CSS. */
export const cssOf = (hue: number | null): string =>
  hue === null ? 'var(--bts-text)' : `hsl(${hue} 70% var(--bts-path-lightness))`;
