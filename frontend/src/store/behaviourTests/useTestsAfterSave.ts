import { useEffect } from 'react';
import { useProjectStore } from '@/store/project';
import { useSavingStore } from '@/store/saving/store';
import { runChangedTests } from './report';

/** Returns whether a file holds behaviour tests. */
export const isTestFile = (path: string): boolean => /^tests\/.*\.test\.ya?ml$/.test(path);

/** Returns whether the project has behaviour tests. */
export const useHasTests = (): boolean => useProjectStore(({ files }) => Object.keys(files).some(isTestFile));

/** Runs the project's behaviour tests now and after each save, while it is mounted and there are any. */
export function useTestsAfterSave(): void {
  const hasTests = useHasTests();
  const projectId = useProjectStore((state) => state.projectId);
  const edits = useProjectStore((state) => state.changeCounter);
  const isSaved = useSavingStore((state) => state.state.kind === 'saved');
  useEffect(() => {
    if (hasTests && isSaved) void runChangedTests();
  }, [hasTests, projectId, edits, isSaved]);
}
