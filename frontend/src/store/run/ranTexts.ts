import { useProjectStore } from '@/store/project';
import { currentText } from '@/store/project/files';
import { treeIdOf, type ProjectData } from '@/store/project/state';
import { useRunStore } from './store';

/** When the project is compared after an edit, so that one who types does not wait for it. */
const AFTER_MS = 200;

function isEqual(one: ProjectData, other: ProjectData): boolean {
  const isSame = (path: string) => {
    const tree = treeIdOf(path) ?? '';
    const isUntouched = one.files[path] === other.files[path] && one.diagrams[tree] === other.diagrams[tree];
    return isUntouched || (path in other.files && currentText(one, path) === currentText(other, path));
  };
  const paths = Object.keys(one.files);
  const settings = ({ mainTree, settings }: ProjectData) => JSON.stringify([mainTree, settings]);
  const areAll = paths.length === Object.keys(other.files).length && paths.every(isSame);
  return areAll && settings(one) === settings(other);
}

/**
 * Counts the project as that which runs once edits have led back to its texts, as by undo; returns a function
 * that stops it.
 */
export function followRanTexts(): () => void {
  let ran: ProjectData | null = null;
  let timer: ReturnType<typeof setTimeout> | undefined;

  const keep = () => {
    const project = useProjectStore.getState();
    if (useRunStore.getState().ranAt === project.changeCounter) ran = project;
  };
  const compare = () => {
    const project = useProjectStore.getState();
    const { ranAt, stage } = useRunStore.getState();
    if (ran && stage === null && project.changeCounter !== ranAt && isEqual(ran, project))
      useRunStore.setState({ ranAt: project.changeCounter });
  };
  keep();
  const stops = [
    useRunStore.subscribe((now, before) => {
      // Edits that were made while the program started are not in what runs.
      if (now.ranAt !== before.ranAt) ran = null;
      if (now.ranAt !== before.ranAt || (now.stage === null && before.stage !== null)) keep();
    }),
    useProjectStore.subscribe((now, before) => {
      if (now.projectId !== before.projectId) {
        ran = null;
        return keep();
      }
      if (now.changeCounter === before.changeCounter) return;
      clearTimeout(timer);
      timer = setTimeout(compare, AFTER_MS);
    }),
  ];
  return () => {
    clearTimeout(timer);
    stops.forEach((stop) => stop());
  };
}
