import type { TemplateInfo } from '@/api/types';

export type Level = 1 | 2 | 3;

/** The examples from the easiest to the hardest, each with its level. */
export const SHELF = [
  ['laser_bump_and_go', 1],
  ['follow_wall', 1],
  ['follow_line', 1],
  ['patrol_battery', 2],
  ['search_color', 2],
  ['push_box', 2],
  ['cross_crowd', 2],
  ['visual_follow_person', 3],
  ['hand_over', 3],
  ['explore_maze', 3],
] as const satisfies readonly (readonly [string, Level])[];

export type ExampleId = (typeof SHELF)[number][0];

export interface Example {
  readonly id: ExampleId;
  readonly level: Level;
  /** The place of the example on the shelf, from 1. */
  readonly number: number;
  readonly template: TemplateInfo;
}

export const isExample = (id: string): id is ExampleId => SHELF.some(([known]) => known === id);

/** Returns the examples that the server offers, in the order of the shelf. */
export function examplesOf(templates: readonly TemplateInfo[]): readonly Example[] {
  return SHELF.flatMap(([id, level], index) => {
    const template = templates.find((each) => each.id === id);
    return template ? [{ id, level, number: index + 1, template }] : [];
  });
}

const pictures = import.meta.glob<string>('./pictures/*.webp', {
  eager: true,
  query: '?url',
  import: 'default',
});

/** Returns the address of an example's picture: its own, or that of its built-in universe. */
export function pictureOf({ id, template }: Example): string | null {
  const own = pictures[`./pictures/${id}.webp`];
  if (own) return own;
  return template.universe ? `/api/v1/catalog/universes/${template.universe}/preview` : null;
}
