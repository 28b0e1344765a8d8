import { useTranslation } from 'react-i18next';
import type { Level } from '@/store/behaviourTests/coverage';
import classes from './coverage.module.css';

/** The sign of a level: an empty, half or full square, so that it does not depend on colours, and is no status. */
export function LevelSign({ level }: { readonly level: Level }) {
  return (
    <svg
      className={classes['sign']}
      data-level={level}
      viewBox="0 0 16 16"
      width={16}
      height={16}
      aria-hidden="true"
    >
      <rect className={classes['frame']} x={2} y={2} width={12} height={12} />
      {level === 'never' && <path className={classes['stroke']} d="M2 14 L14 2" />}
      {level === 'partly' && <path className={classes['part']} d="M2 8 H14 V14 H2 Z" />}
      {level === 'fully' && <rect className={classes['part']} x={2} y={2} width={12} height={12} />}
    </svg>
  );
}

interface CoverageMarkProps {
  readonly level: Level;
  readonly width: number;
  readonly height: number;
}

/** The coverage of a block on the canvas: a pattern over blocks that were never ticked, and a sign. */
export function CoverageMark({ level, width, height }: CoverageMarkProps) {
  const { t } = useTranslation('behaviourTests');
  const title = t(`level.${level}`);
  return (
    <>
      <span className={classes['cover']} data-level={level} style={{ width, height }} aria-hidden="true" />
      <span
        className={classes['mark']}
        role="img"
        aria-label={title}
        title={title}
        data-testid="coverage-mark"
        data-level={level}
      >
        <LevelSign level={level} />
      </span>
    </>
  );
}
