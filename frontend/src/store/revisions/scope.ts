import { create } from 'zustand';

type Scope = 'file' | 'project';

/** Whether the history shows the document in front or the whole project. */
export const useScope = create<{ readonly scope: Scope }>(() => ({ scope: 'file' }));

export const setScope = (scope: Scope): void => {
  useScope.setState({ scope });
};
