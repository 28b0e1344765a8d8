import { MantineProvider } from '@mantine/core';
import { createRoot } from 'react-dom/client';
import '@/i18n';
import '@/ui/global.css';
import { colorSchemeManager, cssVariablesResolver, theme } from '@/ui/theme';
import { Canvas } from '@/features/canvas/Canvas';
import { registerCanvasCommands } from '@/features/canvas/commands/canvasCommands';
import { Inspector } from '@/features/inspector/Inspector';
import { Outline } from '@/features/outline/Outline';
import { Palette } from '@/features/palette/Palette';
import { useLiveStore } from '@/store/project/live';
import { useProjectStore } from '@/store/project';
import { setNavigator } from '@/store/project/navigation';
import { fixture } from './fixture';

const query = new URLSearchParams(location.search);
const tree = query.get('tree') ?? 'MainTree';
useProjectStore.getState().load(fixture(Number(query.get('count') ?? 600)));
useProjectStore.getState().setActiveTree(tree);
registerCanvasCommands();
setNavigator({
  openTree: (id) => {
    location.search = `?tree=${id}`;
  },
  showTree: () => true,
  openFile: () => undefined,
  showFile: () => undefined,
  openTopics: () => undefined,
  focusField: () => undefined,
  aimAt: () => undefined,
  renamed: () => undefined,
});
Object.assign(window, { project: useProjectStore, live: useLiveStore });

createRoot(document.getElementById('root')!).render(
  <MantineProvider
    theme={theme}
    cssVariablesResolver={cssVariablesResolver}
    colorSchemeManager={colorSchemeManager}
    forceColorScheme={query.get('theme') === 'dark' ? 'dark' : 'light'}
  >
    <div style={{ display: 'grid', gridTemplateColumns: '230px 1fr 320px', height: '100vh' }}>
      <div
        style={{
          display: 'grid',
          gridTemplateRows: 'minmax(0, 1fr) 260px',
          height: '100vh',
          borderRight: '1px solid var(--bts-border)',
        }}
      >
        <Palette />
        <Outline />
      </div>
      <Canvas treeId={tree} />
      <div
        style={{
          borderLeft: '1px solid var(--bts-border)',
          overflow: 'auto',
          background: 'var(--bts-surface)',
        }}
      >
        <Inspector />
      </div>
    </div>
  </MantineProvider>,
);
