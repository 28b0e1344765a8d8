import { runs, type StoredRun } from '@/api/runs';
import classes from './thumbnail.module.css';

/** A small picture of a run; an empty field where there is none. The text beside it has the same facts. */
export function Thumbnail({ projectId, run }: { readonly projectId: string; readonly run: StoredRun }) {
  if (!run.has_thumbnail) return <span className={classes['none']} aria-hidden="true" />;
  return (
    <img className={classes['picture']} src={runs.thumbnailUrl(projectId, run.id)} alt="" loading="lazy" />
  );
}
