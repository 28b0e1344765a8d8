import { ModalsProvider } from '@mantine/modals';
import { Notifications } from '@mantine/notifications';
import { Suspense } from 'react';
import { ErrorBoundary } from '@/frame/ErrorBoundary';
import { Waiting } from '@/frame/Waiting';
import { StartPage } from '@/features/projects/StartPage';
import { useRoute } from '@/store/route';
import { preparedPart } from '@/ui/parts';

const [AttachedStudio, loadAttached] = preparedPart(
  async () => (await import('@/frame/attached/AttachedStudio')).AttachedStudio,
);
const [Studio, loadStudio] = preparedPart(async () => (await import('@/frame/Studio')).Studio);

export function App() {
  const route = useRoute((state) => state.route);
  return (
    <ModalsProvider>
      <Notifications position="bottom-left" limit={4} />
      <ErrorBoundary>
        {route.page === 'start' ? (
          <StartPage loadStudio={loadStudio} loadAttached={loadAttached} />
        ) : route.page === 'attached' ? (
          <Suspense fallback={<Waiting reason="openingProject" />}>
            <AttachedStudio key={route.sessionId} sessionId={route.sessionId} />
          </Suspense>
        ) : (
          <Suspense fallback={<Waiting reason="openingProject" />}>
            <Studio key={route.projectId} projectId={route.projectId} />
          </Suspense>
        )}
      </ErrorBoundary>
    </ModalsProvider>
  );
}
