import { useEffect, useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import { EditorFrame } from '@/features/editor3d/EditorFrame';
import { followTexts } from '@/features/editor3d/editing';
import { readUniverse } from '@/model/universe/read';
import { useProjectStore } from '@/store/project';
import { editorOf } from './editor';
import { UniversePanel } from './UniversePanel';
import { UniverseToolbar } from './UniverseToolbar';
import { UniverseView } from './UniverseView';

/** The tab of a universe in the project: 3D view and text. */
export function UniverseTab({ path }: { readonly path: string }) {
  const { t } = useTranslation('universeEditor');
  const editor = useMemo(() => editorOf(path), [path]);
  const text = useProjectStore((state) => state.currentText(path));
  const { universe, problems } = useMemo(() => readUniverse(text ?? ''), [text]);

  useEffect(() => {
    if (text !== null) followTexts(editor);
  }, [editor, text]);

  return (
    <EditorFrame
      editor={editor}
      testId="universe-editor"
      paths={text === null ? [] : [path]}
      problems={problems}
      words={{
        unreadable: t('unreadable'),
        problems: t('problems', { count: problems.length }),
      }}
      toolbar={<UniverseToolbar editor={editor} />}
    >
      {universe ? (
        <>
          <UniverseView editor={editor} universe={universe} />
          <UniversePanel editor={editor} universe={universe} />
        </>
      ) : null}
    </EditorFrame>
  );
}
