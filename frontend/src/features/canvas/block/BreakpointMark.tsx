import type { TFunction } from 'i18next';
import { breakpointOf, toggleBreakpoint, useBreakpoints } from '@/store/debug/breakpoints';
import classes from './Block.module.css';

interface BreakpointMarkProps {
  readonly tree: string;
  readonly node: string;
  /** Whether the block is selected: then the place of the dot shows, also without a breakpoint. */
  readonly isSelected: boolean;
  readonly t: TFunction<'canvas'>;
}

/**
 * The dot of a block's breakpoint; a press sets or removes it, as F9 does. It is hollow while it has no
 * effect, and has another form where a condition decides.
 */
export function BreakpointMark({ tree, node, isSelected, t }: BreakpointMarkProps) {
  const breakpoint = useBreakpoints((state) => breakpointOf(state, tree, node));
  const areOn = useBreakpoints((state) => state.areOn);
  if (!breakpoint && !isSelected) return null;
  const isOff = breakpoint !== undefined && !(areOn && breakpoint.on);
  const state = !breakpoint ? 'none' : isOff ? 'off' : breakpoint.when === 'before' ? 'before' : 'other';
  const label = t(`breakpoint.${state}`);
  return (
    <button
      type="button"
      tabIndex={-1}
      className={`${classes['breakpoint']} nodrag`}
      data-state={state}
      data-condition={breakpoint?.condition || breakpoint?.log ? '' : undefined}
      data-testid={`breakpoint-${node}`}
      aria-label={label}
      aria-pressed={breakpoint !== undefined}
      title={`${label} (F9)`}
      onClick={(event) => {
        event.stopPropagation();
        toggleBreakpoint(tree, node);
      }}
      onDoubleClick={(event) => event.stopPropagation()}
    />
  );
}
