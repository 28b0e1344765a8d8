import { useEffect, useState } from 'react';
import { useProjects } from './useProjects';

const KEY = 'bts.start.folded';

/**
 * Returns whether templates and examples are folded: as the user left them during this visit, otherwise only
 * if there are projects. Until the server answers, the state of the last visit is kept, so that nothing
 * moves.
 */
export function useFold(): { isFolded: boolean; isKnown: boolean; toggle: () => void } {
  const { data } = useProjects('', '-updated_at', 'current');
  const [chosen, setChosen] = useState<boolean | null>(null);
  const hasProjects = data?.pages[0] ? data.pages[0].total > 0 : null;
  useEffect(() => {
    if (hasProjects !== null) localStorage.setItem(KEY, String(hasProjects));
  }, [hasProjects]);
  const isFolded = chosen ?? hasProjects ?? localStorage.getItem(KEY) === 'true';
  return { isFolded, isKnown: hasProjects !== null, toggle: () => setChosen(!isFolded) };
}
