import { Button } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { breakpointOf, toggleBreakpoint, useBreakpoints } from '@/store/debug/breakpoints';
import { BreakpointFields } from './BreakpointFields';
import { ForceFields } from './ForceFields';
import { StopValues } from './StopValues';
import classes from './debug.module.css';

interface DebugSectionProps {
  readonly tree: string;
  readonly node: string;
}

/** The debugger at the selected block: its breakpoint, what is forced on it, and its ports at a stop. */
export function DebugSection({ tree, node }: DebugSectionProps) {
  const { t } = useTranslation('debug');
  const breakpoint = useBreakpoints((state) => breakpointOf(state, tree, node));
  const refusal = useBreakpoints((state) => state.refusal);
  return (
    <section className={classes['section']} aria-label={t('title')} data-testid="debug-section">
      <div className={classes['buttons']}>
        <h2>{t('title')}</h2>
        <Button
          size="compact-xs"
          variant="default"
          data-testid="inspector-breakpoint"
          onClick={() => toggleBreakpoint(tree, node)}
        >
          {t(breakpoint ? 'remove' : 'set')}
        </Button>
      </div>
      <StopValues tree={tree} node={node} />
      {breakpoint && <BreakpointFields key={`${tree}/${node}`} breakpoint={breakpoint} />}
      {breakpoint && refusal && (
        <p className={classes['refusal']} role="alert">
          {refusal}
        </p>
      )}
      <ForceFields key={`force ${tree}/${node}`} tree={tree} node={node} />
    </section>
  );
}
