import { create } from 'zustand';
import type { Insertion } from '@/model/reuse';
import { planHere, type Delivery } from '@/store/project/bringing';

/** Files that the user looks at before they become part of the project. */
export interface Arrivals extends Delivery {
  /** Why they come: the dialogue's title and its button say so. */
  readonly act: 'paste' | 'insert';
  /** The project that they come from, or the behaviour. */
  readonly name: string;
  readonly take: (plan: Insertion) => void;
}

/** The dialogue that shows what comes. */
export const useArrivals = create<{ arrivals: Arrivals | null }>(() => ({ arrivals: null }));

export const closeArrivals = () => useArrivals.setState({ arrivals: null });

/**
 * Brings files to the project, after a look at them: pasted ones if any is not here yet, those of the library
 * if a name is taken by something else.
 */
export function bring(arrivals: Arrivals): void {
  const plan = planHere(arrivals);
  const asks = plan.arrivals.some(({ state }) =>
    arrivals.act === 'paste' ? state !== 'same' : state === 'rename',
  );
  if (asks) useArrivals.setState({ arrivals });
  else arrivals.take(plan);
}
