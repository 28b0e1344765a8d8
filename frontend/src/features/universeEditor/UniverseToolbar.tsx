import { IconWall } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import { perform } from '@/commands/registry';
import { EditorToolbar, Tool } from '@/features/editor3d/EditorToolbar';
import { useProjectStore } from '@/store/project';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { GRIDS, type UniverseEditor } from './editor';

/** The toolbar: the tools of all editors, and the wall tool. */
export function UniverseToolbar({ editor }: { readonly editor: UniverseEditor }) {
  const { t } = useTranslation('universeEditor');
  const tool = useStore(editor.store, (state) => state.tool);
  const runHere = () => {
    const universe = editor.path.replace(/^universes\/|\.yaml$/g, '');
    const { settings } = useProjectStore.getState();
    useUniverseChoice.setState({ universe: settings?.universe === universe ? null : universe });
    perform('run.run');
  };
  return (
    <EditorToolbar
      editor={editor}
      label={t('tools')}
      modes={['move', 'turn', 'size']}
      grids={GRIDS}
      textLabel={t('text')}
      textTestId="universe-text"
      onRun={runHere}
    >
      <Tool
        label={`${t('drawWalls')} (W)`}
        isPressed={tool === 'wall'}
        testId="draw-walls"
        onClick={() => editor.store.setState({ tool: tool === 'wall' ? 'select' : 'wall', placing: null })}
      >
        <IconWall size={18} />
      </Tool>
    </EditorToolbar>
  );
}
