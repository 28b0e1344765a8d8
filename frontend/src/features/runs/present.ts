import type { MyRun } from '@/api/runs';
import { projectPath } from '@/store/route';

/** Returns a duration as minutes and seconds, such as "2:05". */
export function minutes(seconds: number): string {
  const whole = Math.floor(seconds);
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')}`;
}

/** Returns the path of the page that shows a run of the user at its begin. */
export const pathOf = ({ project, id }: Pick<MyRun, 'project' | 'id'>): string =>
  `${projectPath(project)}?run=${id}`;
