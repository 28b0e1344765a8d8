import type { TFunction } from 'i18next';
import { useComparing } from '@/store/moment/compare/comparing';
import type { LiveKey } from '@/store/project/live';
import { cssOf, hueOf } from '@/store/session/trace/shownPaths';
import classes from './Block.module.css';

interface ComparedMarkProps {
  readonly block: LiveKey;
  readonly t: TFunction<'canvas'>;
}

/** The mark of a block whose status differs from that in the run that is compared, with the status there. */
export function ComparedMark({ block, t }: ComparedMarkProps) {
  const there = useComparing((state) => state.blocks.get(block));
  if (there === undefined) return null;
  return (
    <span
      className={classes['compared']}
      style={{ borderLeftColor: cssOf(hueOf(2)) }}
      data-testid={`compared-${block}`}
    >
      {there === null ? t('compared.absent') : t('compared.status', { status: t(`run:status.${there}`) })}
    </span>
  );
}
