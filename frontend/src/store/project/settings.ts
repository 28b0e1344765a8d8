import type { ProjectDetail, ProjectSettings } from '@/api/types';
import { ROS_DISTROS } from '@/model/rosDistros';

const isText = (value: unknown): boolean => typeof value === 'string';
const isOneOf =
  (...choices: readonly unknown[]) =>
  (value: unknown): boolean =>
    choices.includes(value);

const FITS: Readonly<Record<string, (value: unknown) => boolean>> = {
  name: isText,
  description: isText,
  main_tree: isText,
  tick_hz: Number.isFinite,
  universe: isText,
  robot: isText,
  on_finish: isOneOf('stop', 'repeat'),
  on_error: isOneOf('stop', 'failure'),
  time: isOneOf('exact', 'live'),
  ros_distro: isOneOf(...ROS_DISTROS),
};

const fits = (key: string, value: unknown): boolean => FITS[key]?.(value) ?? true;

const areSettings = (settings: Readonly<Record<string, unknown>>): settings is ProjectSettings =>
  ['name', 'main_tree'].every((key) => key in settings) &&
  Object.entries(settings).every(([key, value]) => fits(key, value));

/**
 * Returns a project's settings as the page uses them. A setting of the wrong type gets its default, as in the
 * translator.
 */
export function readSettings({
  name,
  main_tree,
  settings,
}: Pick<ProjectDetail, 'name' | 'main_tree' | 'settings'>): ProjectSettings {
  const said = Object.entries(settings).filter(([key, value]) => fits(key, value));
  const read: Readonly<Record<string, unknown>> = { name, main_tree, ...Object.fromEntries(said) };
  return areSettings(read) ? read : { name, main_tree };
}
