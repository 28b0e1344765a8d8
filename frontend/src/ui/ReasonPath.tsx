import { useTranslation } from 'react-i18next';
import type { ReasonStep } from '@/store/project/problems';
import { openBlock } from '@/store/problems/open';
import classes from './findings.module.css';

interface ReasonPathProps {
  readonly path: readonly ReasonStep[];
}

/** The nodes from which a finding follows, each with its results or what it does; a press shows the block. */
export function ReasonPath({ path }: ReasonPathProps) {
  const { t } = useTranslation('problems');
  if (path.length === 0) return null;
  return (
    <ol className={classes['path']} aria-label={t('path.label')}>
      {path.map((step, index) => (
        <li key={index}>
          <button
            type="button"
            data-testid={`step-${index}`}
            title={t('path.open', { tree: step.tree, name: step.label })}
            onClick={() => {
              openBlock(step);
            }}
          >
            {step.label}
          </button>{' '}
          <span className={classes['does']}>
            {step.role === 'reads' || step.role === 'writes' || step.role === 'commands'
              ? t(`path.${step.role}`, { what: step.what })
              : step.results.join(' · ')}
          </span>
        </li>
      ))}
    </ol>
  );
}
