import { useEffect, useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import { perform } from '@/commands/registry';
import { EditorFrame } from '@/features/editor3d/EditorFrame';
import { EditorToolbar } from '@/features/editor3d/EditorToolbar';
import { LargeFile } from '@/features/code/LargeFile';
import { followTexts } from '@/features/editor3d/editing';
import { readRobot } from '@/model/robot/read';
import { useProjectStore } from '@/store/project';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { editorOf, GRIDS, urdfPathOf, type RobotEditor } from './editor';
import { RobotPanel } from './RobotPanel';
import { RobotView } from './RobotView';

/** The tab of a robot in the project: 3D view, configuration and URDF. */
export function RobotTab({ path }: { readonly path: string }) {
  const { t } = useTranslation('robotEditor');
  const editor = useMemo(() => editorOf(path), [path]);
  const yaml = useProjectStore((state) => state.currentText(path));
  const urdfPath = urdfPathOf(path, yaml ?? '');
  const urdf = useProjectStore((state) => (urdfPath === null ? null : state.currentText(urdfPath)));
  const isLarge = useProjectStore((state) => urdfPath !== null && state.files[urdfPath]?.kind === 'large');
  const { robot, problems } = useMemo(() => readRobot(yaml ?? '', urdf), [yaml, urdf]);

  useEffect(() => {
    if (yaml !== null) followTexts(editor);
  }, [editor, yaml, urdf]);

  if (isLarge && urdfPath !== null) return <LargeFile path={urdfPath} />;
  const paths = [...(yaml === null ? [] : [path]), ...(urdf === null || urdfPath === null ? [] : [urdfPath])];
  return (
    <EditorFrame
      editor={editor}
      testId="robot-editor"
      paths={paths}
      problems={problems}
      words={{
        unreadable: t('unreadable'),
        problems: t('problems', { count: problems.length }),
      }}
      toolbar={<RobotToolbar editor={editor} />}
    >
      {robot ? (
        <>
          <RobotView editor={editor} robot={robot} />
          <RobotPanel editor={editor} robot={robot} />
        </>
      ) : null}
    </EditorFrame>
  );
}

/** The toolbar: the tools of all editors, and a button that runs the robot in the chosen universe. */
function RobotToolbar({ editor }: { readonly editor: RobotEditor }) {
  const { t } = useTranslation('robotEditor');
  const runHere = () => {
    const id = editor.path.split('/')[1] ?? '';
    const { settings } = useProjectStore.getState();
    useUniverseChoice.setState({ robot: settings?.robot === id ? null : id });
    perform('run.run');
  };
  return (
    <EditorToolbar
      editor={editor}
      label={t('tools')}
      modes={['move', 'turn']}
      grids={GRIDS}
      textLabel={t('text')}
      textTestId="robot-text"
      onRun={runHere}
    />
  );
}
