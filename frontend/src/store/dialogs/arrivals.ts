import { create } from 'zustand';
import type { Insertion } from '@/model/reuse';
import { planHere, type Delivery } from '@/store/project/bringing';

/** Files that the user reviews before they are added to the project. */
export interface Arrivals extends Delivery {
  /** The reason why the files are added, which the dialogue's title and button state. */
  readonly act: 'paste' | 'insert';
  /** The name of the project or the behaviour that the files come from. */
  readonly name: string;
  readonly take: (plan: Insertion) => void;
}

/** The state of the dialogue that shows incoming files. */
export const useArrivals = create<{ arrivals: Arrivals | null }>(() => ({ arrivals: null }));

export const closeArrivals = () => useArrivals.setState({ arrivals: null });

/**
 * Adds files to the project. The user reviews them first: pasted files if any of them is new, files of the
 * library if another file has the name of one.
 */
export function bring(arrivals: Arrivals): void {
  const plan = planHere(arrivals);
  const asks = plan.arrivals.some(({ state }) =>
    arrivals.act === 'paste' ? state !== 'same' : state === 'rename',
  );
  if (asks) useArrivals.setState({ arrivals });
  else arrivals.take(plan);
}
