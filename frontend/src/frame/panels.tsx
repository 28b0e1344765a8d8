import { Suspense, type ReactNode } from 'react';
import type { TabNode } from 'flexlayout-react';
import { BlackboardPanel } from '@/features/blackboard/BlackboardPanel';
import { Canvas } from '@/features/canvas/Canvas';
import { ConsolePanel } from '@/features/console/ConsolePanel';
import { BreakpointsPanel } from '@/features/debug/BreakpointsPanel';
import { LessonPanel } from '@/features/lesson/LessonPanel';
import { Inspector } from '@/features/inspector/Inspector';
import { Library } from '@/features/library/Library';
import { Outline } from '@/features/outline/Outline';
import { Palette } from '@/features/palette/Palette';
import { ProblemsPanel } from '@/features/problems/ProblemsPanel';
import { TestsPanel } from '@/features/behaviourTests/TestsPanel';
import { TimelinePanel } from '@/features/timeline/TimelinePanel';
import { TopicsPanel } from '@/features/topics/TopicsPanel';
import { CameraPanel } from '@/features/viewer/pictures/CameraPanel';
import { VideoPanel } from '@/features/viewer/pictures/VideoPanel';
import { useProjectStore } from '@/store/project';
import { ROBOT_FILE } from '@/store/dialogs/newRobot';
import { UNIVERSE_FILE } from '@/store/dialogs/newUniverse';
import { lazyPart } from '@/ui/parts';
import { ErrorBoundary } from './ErrorBoundary';
import { Explorer } from '@/features/explorer/Explorer';
import { cameraOf, chooseCamera, openCameraBelow } from '@/workspace/cameraViews';
import type { PanelId } from '@/workspace/layoutModel';
import { InItsWindow } from './popouts';
import { Presented } from './presentation/Presented';
import { documentOf, useTabs } from '@/workspace/tabs';
import { Waiting } from './Waiting';

const Viewer3d = lazyPart(async () => (await import('@/features/viewer/Viewer3d')).Viewer3d);
const XmlPanel = lazyPart(async () => (await import('@/features/xml/XmlPanel')).XmlPanel);
const SearchPanel = lazyPart(async () => (await import('@/features/search/SearchPanel')).SearchPanel);
const EvaluatePanel = lazyPart(async () => (await import('@/features/evaluate/EvaluatePanel')).EvaluatePanel);
const ProfilePanel = lazyPart(async () => (await import('@/features/profile/ProfilePanel')).ProfilePanel);
const RevisionsPanel = lazyPart(
  async () => (await import('@/features/revisions/RevisionsPanel')).RevisionsPanel,
);
const CompareTab = lazyPart(async () => (await import('@/features/revisions/CompareTab')).CompareTab);
const PastTab = lazyPart(async () => (await import('@/features/recorded/PastTab')).PastTab);
const UniverseTab = lazyPart(async () => (await import('@/features/universeEditor/UniverseTab')).UniverseTab);
const RobotTab = lazyPart(async () => (await import('@/features/robotEditor/RobotTab')).RobotTab);
const SourceTab = lazyPart(async () => (await import('@/features/code/SourceTab')).SourceTab);
const CodeTab = lazyPart(async () => (await import('@/features/code/CodeTab')).CodeTab);

const panels: Record<PanelId, (node: TabNode) => ReactNode> = {
  explorer: () => <Explorer />,
  search: () => (
    <Suspense fallback={<Waiting reason="loadingEditor" />}>
      <SearchPanel />
    </Suspense>
  ),
  outline: () => <Outline />,
  palette: () => <Palette />,
  library: () => <Library />,
  inspector: () => <Inspector />,
  blackboard: () => <BlackboardPanel />,
  viewer3d: () => (
    <Suspense fallback={<Waiting reason="loadingViewer" />}>
      <Viewer3d />
    </Suspense>
  ),
  video: () => <VideoPanel />,
  camera: (node) => (
    <CameraPanel
      chosen={cameraOf(node)}
      onChoose={(camera) => chooseCamera(node, camera)}
      onAnother={(camera) => openCameraBelow(node, camera)}
    />
  ),
  console: () => <ConsolePanel />,
  problems: () => <ProblemsPanel />,
  tests: () => <TestsPanel />,
  evaluate: () => (
    <Suspense fallback={<Waiting reason="loadingEditor" />}>
      <EvaluatePanel />
    </Suspense>
  ),
  timeline: () => <TimelinePanel />,
  topics: () => <TopicsPanel />,
  breakpoints: () => <BreakpointsPanel />,
  profile: () => (
    <Suspense fallback={<Waiting reason="loadingEditor" />}>
      <ProfilePanel />
    </Suspense>
  ),
  history: () => (
    <Suspense fallback={<Waiting reason="loadingEditor" />}>
      <RevisionsPanel />
    </Suspense>
  ),
  lesson: () => <LessonPanel />,
  xml: () => (
    <Suspense fallback={<Waiting reason="loadingEditor" />}>
      <XmlPanel />
    </Suspense>
  ),
};

/** The content of a document's tab. It finds the document by its tab, so that it also follows a rename. */
function Document({ node }: { readonly node: TabNode }) {
  const tab = useTabs(() => documentOf(node));
  if (!tab) return null;
  if (tab.kind === 'tree') return <Canvas treeId={tab.id} />;
  return (
    <Suspense fallback={<Waiting reason="loadingEditor" />}>
      {tab.kind === 'compare' ? (
        <CompareTab />
      ) : tab.kind === 'past' ? (
        <PastTab />
      ) : tab.kind === 'source' ? (
        <SourceTab path={tab.path} />
      ) : (
        <FileTab path={tab.path} />
      )}
    </Suspense>
  );
}

/** The editor of a file: a 3D editor beside the text for universes and robots, otherwise a text editor. */
function FileTab({ path }: { readonly path: string }) {
  const isLarge = useProjectStore((state) => state.files[path]?.kind === 'large');
  if (isLarge) return <CodeTab path={path} />; // it loads the file
  if (ROBOT_FILE.test(path)) return <RobotTab key={path} path={path} />;
  return UNIVERSE_FILE.test(path) ? <UniverseTab key={path} path={path} /> : <CodeTab path={path} />;
}

/** Returns the content of a tab; an exception in one panel does not affect the others. */
export function renderTab(node: TabNode): ReactNode {
  const content = documentOf(node) ? <Document node={node} /> : panels[node.getComponent() as PanelId](node);
  return (
    <InItsWindow node={node}>
      <Presented node={node}>
        <ErrorBoundary>{content}</ErrorBoundary>
      </Presented>
    </InItsWindow>
  );
}
