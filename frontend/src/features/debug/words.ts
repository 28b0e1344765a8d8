import type { Held } from '@/generated/messages';
import type { BlockBreakpoint } from '@/model/breakpoints';
import type { ForcedMark } from '@/store/debug/marks';
import { usePlainWords } from '@/ui/hooks/usePlainWords';

/** Returns the words for a stop: what happens at the node, and why the tree is held there. */
export function useHeldWords(): (held: Held) => string {
  const t = usePlainWords('debug');
  return (held) => {
    const event = t(`event.${held.event}`, { status: held.status ?? '', decided: held.decided });
    const cause = held.cause === 'condition' ? held.why : t(`cause.${held.cause}`);
    return `${event}, ${cause}.`;
  };
}

/** Returns the words for the moment of a breakpoint, with its condition, hits and log line. */
export function useMomentWords(): (each: BlockBreakpoint) => string {
  const t = usePlainWords('debug');
  return (each) =>
    [
      each.when === 'returns' ? t('whenReturns', { status: each.status ?? '' }) : t(`when.${each.when}`),
      each.condition && t('ifCondition', { condition: each.condition }),
      each.hits > 1 && t('fromHit', { hits: each.hits }),
      each.log && t('logs', { text: each.log }),
    ]
      .filter(Boolean)
      .join(' · ');
}

/** Returns the words for what is forced on a block. */
export function useForcedWords(): (mark: ForcedMark) => string {
  const t = usePlainWords('debug');
  return ({ alone, status, once, after }) =>
    alone
      ? t('forced.alone')
      : status === 'RUNNING'
        ? t('forced.frozen')
        : t(`forced.${once ? 'once' : 'always'}${after ? 'After' : ''}`, { status });
}
