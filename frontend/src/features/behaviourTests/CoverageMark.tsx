import { useTranslation } from 'react-i18next';
import type { Level } from '@/store/behaviourTests/coverage';
import classes from './coverage.module.css';

/** The sign of a level: an empty, half or full disc, so that it does not depend on colours. */
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
      <circle className={classes['disc']} cx={8} cy={8} r={6} />
      {level === 'never' && <path className={classes['stroke']} d="M4 12 L12 4" />}
      {level === 'partly' && <path className={classes['part']} d="M8 2 A6 6 0 0 1 8 14 Z" />}
      {level === 'fully' && (
        <>
          <circle className={classes['part']} cx={8} cy={8} r={6} />
          <path className={classes['check']} d="M5 8.2 L7.2 10.4 L11 6" />
        </>
      )}
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
